"""A simulated person with a mouse, who sees, reacts with a delay, and moves the target of the simulated hand."""

import itertools

import numpy as np
import pytest
from attempts import HERTZ, as_a_device_runs_it
from punctura.exercise import Attempt, load_exercise
from punctura.simulation import Experiment, Target
from runs import of_trace, unit


class Person:
    """Goes fast until the cue, then slowly until the pop; draws back while the needle presses on the wall behind."""

    def __init__(self, fast, slow, reaction, seed=0, draws_back=True):
        """Speeds in m/s, the reaction in s."""
        self.fast, self.slow, self.reaction, self.seed, self.draws_back = fast, slow, reaction, seed, draws_back

    def tries(self, name, cue, pop, seconds=40):
        """cue: of an attempt, whether it is to be seen. pop: the membrane at whose pop to stop."""
        exercise = load_exercise(name)
        scene = as_a_device_runs_it(exercise.scene)
        axis, start = np.asarray(exercise.start_axis), np.asarray(exercise.start_position)
        device = Experiment(scene, Target(start), seed=self.seed, axis=axis)
        attempt, way, ticks, seen = Attempt(exercise, scene), 0.0, 0, []
        while ticks < seconds * scene.servo.rate and not attempt.over:
            way += self._speed(seen) / HERTZ
            device.move_to(start + way * axis)
            trace = device.run(1 / HERTZ)
            n = len(trace.time)
            columns = of_trace(trace) | {
                "tick": np.arange(ticks, ticks + n),
                "time": trace.time,
                "tip": trace.position,
                "model_force": trace.model_force,
                "axis": np.tile(unit(axis), (n, 1)),
            }
            ticks += n
            attempt.add(columns)
            result = attempt.finish()
            popped = any(e.what == "pop" and e.name == pop for e in result.events)
            seen.append((cue(result), popped, "press against" in attempt.status.instruction))
        return attempt.finish()

    def _speed(self, seen):
        late = max(1, round(self.reaction * HERTZ))
        cue, popped, pressing = seen[-late] if len(seen) >= late else (False, False, False)
        if popped:
            return -2e-3 if pressing and self.draws_back else 0.0
        return self.slow if cue else self.fast


WAYS = {"towards you": (0, 0, 1), "away from you": (0, 0, -1), "to the right": (1, 0, 0), "to the left": (-1, 0, 0)}


class ByKeys:
    """Presses a key eight times a second, and does nothing but what the instruction says."""

    TURNS = 8  # a second

    def __init__(self, blind_s=0.0):
        """blind_s: until it begins to read the instruction."""
        self.blind_s = blind_s

    def tries(self, name, seconds=60):
        exercise = load_exercise(name)
        scene = as_a_device_runs_it(exercise.scene)
        axis, target = np.asarray(exercise.start_axis), np.array(exercise.start_position)
        device = Experiment(scene, Target(target), axis=axis)
        attempt, ticks, self.heard = Attempt(exercise, scene), 0, []
        while ticks < seconds * scene.servo.rate and not attempt.over:
            task = attempt.status.instruction if ticks >= self.blind_s * scene.servo.rate else ""
            self.heard += [task] if task not in self.heard else []
            target = target + self._key(task, axis)
            device.move_to(target)
            trace = device.run(1 / self.TURNS)
            n = len(trace.time)
            tick = np.arange(ticks, ticks + n)
            moved = {"tick": tick, "time": trace.time, "tip": trace.position, "model_force": trace.model_force}
            attempt.add(of_trace(trace) | moved | {"axis": np.tile(unit(axis), (n, 1))})
            ticks += n
        return attempt.finish()

    def _key(self, task, axis):
        if "Hold still" in task:
            return 0 * axis
        if "draw back" in task:
            return -0.25e-3 * axis
        if "draw it out" in task:
            return -1e-3 * axis
        way = next((np.array(way) for word, way in WAYS.items() if word in task), None)
        return 0.25e-3 * (axis if way is None else way)


def in_the_vein(result):
    return result.metrics.time_to_target is not None


def at_the_flavum(result):
    return any(event.name == "ligamentum flavum" for event in result.events)


def each(*cases, of):
    """All combinations of the values. Those that are not among the cases run by `./test statistics`."""
    return [pytest.param(*one, marks=() if one in cases else pytest.mark.statistics) for one in itertools.product(*of)]


# Each two of the edges meet once.
EDGES = ((8e-3, 2e-3, 0.2), (8e-3, 6e-3, 0.3), (15e-3, 2e-3, 0.3), (15e-3, 6e-3, 0.2))


@pytest.mark.parametrize(("fast", "slow", "reaction"), each(*EDGES, of=((8e-3, 15e-3), (2e-3, 4e-3, 6e-3), (0.2, 0.3))))
def test_who_slows_down_at_the_flash_back_passes_venipuncture(fast, slow, reaction):
    result = Person(fast, slow, reaction).tries("venipuncture", in_the_vein, "front vein wall")
    assert result.passed, result.reasons


@pytest.mark.parametrize(("slow", "reaction"), each((2e-3, 0.2), (4e-3, 0.3), of=((2e-3, 4e-3), (0.2, 0.3))))
def test_who_slows_down_at_the_flavum_passes_epidural(slow, reaction):
    result = Person(12e-3, slow, reaction).tries("epidural", at_the_flavum, "ligamentum flavum")
    assert result.passed, result.reasons


def test_who_does_not_slow_down_fails_both():
    hasty = Person(15e-3, 15e-3, 0.25, draws_back=False)
    result = hasty.tries("venipuncture", in_the_vein, "front vein wall")
    assert "You went through the back vein wall" in result.reasons[0]
    result = hasty.tries("epidural", at_the_flavum, "ligamentum flavum")
    assert "You ran more than 2.5 mm past the ligamentum flavum" in result.reasons[0]


@pytest.mark.parametrize(
    "name", ["steady-push", "stop-after-pop", "vein-15", "venipuncture", "vein-45", "rolling-vein"]
)
def test_who_does_what_the_instruction_says_passes(name):
    result = ByKeys().tries(name)
    assert result.passed, result.reasons


def test_between_the_skin_and_the_vein_a_cue_says_that_the_needle_points_beside_it():
    person = ByKeys(blind_s=6.5)
    result = person.tries("rolling-vein")
    assert "The needle points 4 mm beside the line: draw it out, and move it towards you." in person.heard
    assert result.passed and result.metrics.entries == 2, result.reasons

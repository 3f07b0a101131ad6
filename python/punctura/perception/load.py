"""Reads and checks protocol files: all problems at once, each with its place, its value and what is right."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from decimal import Decimal
from functools import partial
from pathlib import Path

from punctura import Scene
from punctura._core import ForceLimits
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.toml import read_tables
from punctura.perception.protocol import ANSWERS, ONE_INTERVAL, SCHEMA, Protocol, ProtocolFile, Stimulus
from punctura.perception.stimulus import QUANTITIES, built, cut_by_limits, simulated, solved
from punctura.ready_protocols import protocol_files
from punctura.study.plan import nearest, scene_of

LEAST = {"constant": 40, "staircase": 40, "quest": 20, "adjustment": 6}  # scored trials for a fit
LEAST_LEVELS = 3
MOST_LEVELS, MOST_TRIALS = 100, 10_000


def protocol_names() -> list[str]:
    """Names of the ready protocols, for load_protocol."""
    return list(protocol_files())


def load_protocol(name_or_path: str | os.PathLike[str]) -> Protocol:
    """Loads a ready protocol by its name, or a file. Raises ConfigurationError with all problems."""
    path = protocol_files().get(str(name_or_path), Path(name_or_path))
    if not path.suffix and not path.exists():
        reason = f"no file and no ready protocol has this name; ready protocols: {', '.join(protocol_names())}"
        raise ConfigurationError([Problem("", MISSING, reason)], str(path))
    tables = read_tables(path, "protocol")
    file, problems = SCHEMA.checked(tables)
    scene, found = scene_of(tables, path)
    problems += found
    if file is None:
        raise ConfigurationError(problems, str(path))
    problems += [*_answers(file), *_trials(file), *_stimulus(file, scene)]
    if scene is None or problems:
        raise ConfigurationError(problems, str(path))
    shown = _Shown(file, scene)
    protocol = shown.protocol(path)
    if shown.problems or protocol is None:
        raise ConfigurationError(shown.problems, str(path))
    return protocol


def check_device(protocol: Protocol, limits: ForceLimits) -> None:
    """Raises ConfigurationError with each level that a device with these limits cannot show."""
    asked = [(f"stimulus.levels[{i}]", one) for i, one in enumerate(protocol.stimuli)]
    asked += [("stimulus.reference", one) for one in protocol.references[:1]]
    asked += [("trials.catch_level", protocol.catch)] if protocol.catch else []
    problems = [Problem(key, one.level, reason) for key, one in asked if (reason := cut_by_limits(one.scene, limits))]
    if problems:
        raise ConfigurationError(problems, str(protocol.path))


def _answers(file: ProtocolFile) -> Iterator[Problem]:
    wanted = ANSWERS[file.task]
    if not file.question.strip():
        yield Problem("question", file.question, "must not be empty: it is asked after each trial")
    used: dict[str, str] = {}
    for name, key in file.answers.items():
        if name not in wanted:
            yield Problem(
                f"answers.{name}", key, f"is no answer of {file.task}: {', '.join(wanted) or 'a number is typed'}"
            )
        elif len(key) != 1 or not key.isprintable() or key.isspace():
            yield Problem(f"answers.{name}", key, "must be one key, as a letter or a digit")
        elif key.casefold() in used:
            yield Problem(f"answers.{name}", key, f"is the key of {used[key.casefold()]}, too; give each its own")
        used.setdefault(key.casefold(), name)
    missing = [name for name in wanted if name not in file.answers]
    if file.answers and missing:
        yield Problem(f"answers.{missing[0]}", MISSING, "is missing; give all answers a key, or none")


def _trials(file: ProtocolFile) -> Iterator[Problem]:
    given, levels = file.trials, len(file.stimulus.levels)
    if file.seed < 0:
        yield Problem("seed", file.seed, "must be 0 or more")
    wanted, other = ("per_level", "total") if file.method == "constant" else ("total", "per_level")
    if getattr(given, other) is not None:
        yield Problem(f"trials.{other}", getattr(given, other), f"is not for {file.method}; give {wanted}")
    count = getattr(given, wanted)
    scored = (count or 0) * (levels if file.method == "constant" else 1)
    if count is None:
        yield Problem(f"trials.{wanted}", MISSING, f"is missing; {file.method} needs it")
    elif not LEAST[file.method] <= scored <= MOST_TRIALS:
        few = f"{scored} trials are too few for the fit" if scored < LEAST[file.method] else f"are {scored} trials"
        reason = f"{few}: {file.method} needs from {LEAST[file.method]} to {MOST_TRIALS} without practice and catch"
        yield Problem(f"trials.{wanted}", count, reason)
    elif given.blocks < 1 or count % given.blocks:
        yield Problem("trials.blocks", given.blocks, f"must divide {wanted}, {count}, so that all blocks are alike")
    if (file.method == "adjustment") != (file.task == "adjustment"):
        yield Problem("method", file.method, "and task must both be adjustment, or none of them")
    elif file.method == "adjustment" and given.practice + given.catch:
        yield Problem("trials.practice", given.practice, "and catch are not for adjustment; leave both out")
    for key in ("practice", "catch"):
        if not 0 <= getattr(given, key) <= 1000:
            yield Problem(f"trials.{key}", getattr(given, key), "must be from 0 to 1000")
    if (given.catch > 0) != (given.catch_level is not None):
        key = "catch_level" if given.catch_level is None else "catch"
        yield Problem(f"trials.{key}", MISSING, "is missing: give both catch and catch_level, or none of them")
    for key in ("up", "down"):
        if not 1 <= getattr(given, key) <= 100:
            yield Problem(f"trials.{key}", getattr(given, key), "must be from 1 to 100")
    kept = given.up / max(given.up + given.down, 1)
    guess = 0.0 if file.task == "yes_no" else 1 / max(len(ANSWERS[file.task]), 1)
    if file.method == "staircase" and kept <= guess:
        reason = f"with down = {given.down} it seeks {kept:.0%} right answers, which guessing gives; give a larger up"
        yield Problem("trials.up", given.up, reason)
    if given.break_s is not None and not 0 < float(given.break_s) <= 3600:
        yield Problem("trials.break_s", float(given.break_s), "must be more than 0 and at most 3600 s")


def _stimulus(file: ProtocolFile, scene: Scene | None) -> Iterator[Problem]:
    given = file.stimulus
    levels = [float(level) for level in given.levels]
    if (
        not all(map(math.isfinite, levels))
        or not LEAST_LEVELS <= len(levels) <= MOST_LEVELS
        or sorted(set(levels)) != levels
    ):
        reason = f"must be {LEAST_LEVELS} to {MOST_LEVELS} numbers, each larger than the one before"
        yield Problem("stimulus.levels", levels, reason)
    elif given.scale == "log" and levels[0] <= 0:
        yield Problem("stimulus.levels", levels, 'must be more than 0 with scale = "log"')
    reference = None if given.reference is None else float(given.reference)
    sides = file.task == "two_intervals" and reference is not None and levels and levels[0] < reference < levels[-1]
    if given.scale == "log" and file.task != "yes_no" and not sides:
        yield Problem("stimulus.scale", given.scale, "is for yes_no, and for levels on both sides of a reference")
    by_solver = given.reference_solver is not None
    if file.task == "magnitude" and levels and levels[0] <= 0:
        yield Problem("stimulus.levels", levels, "must be more than 0 for magnitude, whose result is an exponent")
    if file.task in ("rating", "magnitude") and (file.method != "constant" or file.trials.catch):
        yield Problem("task", file.task, "is for constant stimuli without catch trials: change method or catch")
    if file.task in ONE_INTERVAL:
        for key in ("reference", "reference_solver"):
            if getattr(given, key) is not None:
                yield Problem(
                    f"stimulus.{key}", _plain(getattr(given, key)), f"is not for {file.task}, of one interval"
                )
    elif (reference is None) != by_solver:
        reason = f"{file.task} needs a reference, a level, or a reference_solver, and not both"
        yield Problem("stimulus.reference", MISSING if reference is None else reference, reason)
    elif by_solver and file.trials.catch_level is not None:
        reason = "is not for reference_solver: the other intervals would have another level; leave catch out"
        yield Problem("trials.catch_level", float(file.trials.catch_level), reason)
    elif reference is not None and levels:
        one_sided = not min(levels) < reference < max(levels)
        if one_sided and file.task == "adjustment":
            yield Problem("stimulus.reference", reference, "must lie between the levels for adjustment")
        if file.trials.catch_level is not None and float(file.trials.catch_level) == reference:
            yield Problem("trials.catch_level", reference, "is the reference, at which no answer is right")
        elif file.trials.catch_level is not None and one_sided:
            catch_level = float(file.trials.catch_level)
            if (catch_level > reference) != (max(levels) > reference):
                reason = f"must lie on that side of the reference, {reference:g}, where the levels are"
                yield Problem("trials.catch_level", catch_level, reason)
        if not one_sided and (file.method == "staircase" or file.task == "three_intervals"):
            reason = f"must lie at an end of the levels for {file.method} with {file.task}, which score right answers"
            yield Problem("stimulus.reference", reference, reason)
        elif reference in levels and one_sided:
            reason = "is one of the levels, at which no answer is right; leave it out of levels"
            yield Problem("stimulus.reference", reference, reason)
    solvers = ("paper", "exact")
    for key in ("solver", "reference_solver"):
        if getattr(given, key) not in (None, *solvers):
            yield Problem(f"stimulus.{key}", getattr(given, key), f"must be {' or '.join(solvers)}")
    yield from _paths(file, scene)


def _paths(file: ProtocolFile, scene: Scene | None) -> Iterator[Problem]:
    if scene is None:
        return
    given, known = file.stimulus, [one.path for one in scene.fields()]
    quantity = given.variable in QUANTITIES
    asked = {} if quantity else {"stimulus.variable": given.variable}
    if quantity and given.solve is not None:
        asked["stimulus.solve"] = given.solve
    for key, path in [*asked.items(), *((f"values.{path}", path) for path in file.values)]:
        if path not in known:
            words = f" or one of {', '.join(QUANTITIES)}" if key == "stimulus.variable" else ""
            yield Problem(key, path, f"is not a number of the scene{words}{nearest(path, known)}")
    for key in ("solve", "between"):
        if quantity and getattr(given, key) is None:
            yield Problem(f"stimulus.{key}", MISSING, f"is missing; {given.variable} solves a number of the scene")
        elif not quantity and getattr(given, key) is not None:
            yield Problem(f"stimulus.{key}", _plain(getattr(given, key)), f"is for {' and '.join(QUANTITIES)} alone")
    ends = given.between
    if quantity and ends is not None and not (len(ends) == 2 and float(ends[0]) < float(ends[1])):
        yield Problem("stimulus.between", _plain(ends), "must be two numbers, the smaller one first")
    names = [placed.name for placed in scene.membranes]
    if given.membrane is not None and names.count(given.membrane) != 1:
        yield Problem("stimulus.membrane", given.membrane, f"must be one of the scene's membranes: {', '.join(names)}")
    if given.variable in file.values:
        yield Problem(f"values.{given.variable}", given.variable, "is the variable; leave it out here")


def _plain(value: object) -> object:
    if isinstance(value, tuple):
        return [float(one) for one in value]
    return float(value) if isinstance(value, Decimal) else value


class _Shown:
    """The stimuli of a protocol, and the problems of those that no scene can give."""

    def __init__(self, file: ProtocolFile, scene: Scene) -> None:
        self.problems: list[Problem] = []
        self._file = file
        names = [placed.name for placed in scene.membranes]
        wanted = file.stimulus.membrane
        self._membrane = 0 if wanted is None else names.index(wanted)
        if scene.display.force_scale == "automatic":
            reason = 'must not be "automatic", else each level has another scale: give a number in the scene file'
            self.problems.append(Problem("scene: display.force_scale", scene.display.force_scale, reason))
        fixed, reason = built(partial(scene.with_values, {path: float(v) for path, v in file.values.items()}))
        if fixed is None:
            self.problems.append(Problem("values", MISSING, reason))
        self._scene, solve = fixed, str(file.stimulus.solve)
        for end in map(float, file.stimulus.between or ()):
            if fixed is not None and (reason := built(partial(fixed.with_values, {solve: end}))[1]):
                self.problems.append(Problem("stimulus.between", end, reason))
                self._scene = None
        self._made: dict[tuple[float, str | None], Stimulus | None] = {}
        self._unit = next((one.unit for one in scene.fields() if one.path == file.stimulus.variable), "N")

    def protocol(self, path: Path) -> Protocol | None:
        """None with problems."""
        given, trials = self._file.stimulus, self._file.trials
        levels = [float(level) for level in given.levels]
        stimuli = [self._of(f"stimulus.levels[{i}]", level, given.solver) for i, level in enumerate(levels)]
        references: list[Stimulus | None] = []
        if given.reference is not None:
            references = [self._of("stimulus.reference", float(given.reference), given.solver)] * len(levels)
        elif given.reference_solver is not None:
            references = [
                self._of(f"stimulus.levels[{i}]", level, given.reference_solver) for i, level in enumerate(levels)
            ]
        catch = None
        if trials.catch_level is not None:
            catch = self._of("trials.catch_level", float(trials.catch_level), given.solver)
        if self.problems:
            return None
        shown, others = (tuple(one for one in each if one is not None) for each in (stimuli, references))
        protocol = Protocol(path, self._file, shown, others, catch, self._membrane, self._unit)
        if not any(protocol.difference(i) > 0 for i in range(len(shown))):
            reason = f"no level changes the {given.judged} that is judged; choose another variable or judged"
            self.problems.append(Problem("stimulus.levels", levels, reason))
        if catch is not None and self._file.task == "yes_no":
            least, found = (min(getattr(one.felt, given.judged) for one in some) for some in (shown, [catch]))
            if found > least:
                reason = f"must lack what is asked for: its {given.judged} is {found:.3g}, that of a level {least:.3g}"
                self.problems.append(Problem("trials.catch_level", catch.level, reason))
        return protocol

    def _of(self, key: str, level: float, solver: str | None) -> Stimulus | None:
        if (level, solver) not in self._made:
            self._made[level, solver] = self._new(key, level, solver)
        return self._made[level, solver]

    def _new(self, key: str, level: float, solver: str | None) -> Stimulus | None:
        if self._scene is None:
            return None
        base, given = self._scene, self._file.stimulus
        if solver is not None:
            base = base.replace(servo=base.servo.replace(solver=solver))
        if given.variable in QUANTITIES:
            low, high = (float(end) for end in given.between or ())
            make = partial(solved, base, given.variable, level, str(given.solve), (low, high), self._membrane)
        else:
            make = partial(base.with_values, {given.variable: level})
        scene, reason = built(make)
        if scene is None:
            self.problems.append(Problem(key, level, reason))
            return None
        return Stimulus(level, scene, simulated(scene, self._membrane))

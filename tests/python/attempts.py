"""Exercise attempts by a simulated hand, and needle motions known to the micrometre."""

import itertools
from collections.abc import Callable, Iterable
from functools import cache

import numpy as np
import punctura as pn
from punctura import Phase
from punctura.exercise import Attempt, Exercise, Result, load_exercise
from punctura.simulation import RecordedMotion
from runs import Columns, cut, experiment, unit

HERTZ = 60.0  # rate at which a page sends the mouse position


def as_a_device_runs_it(scene: pn.Scene) -> pn.Scene:
    """The scene with conditioning for the encoders of the simulated device, as in `punctura run`."""
    return scene.replace(servo=scene.servo.replace(conditioning="line_fit", encoder_step=0.055e-3))


def motion_of(
    exercise: Exercise,
    legs: list[tuple[float, float]],
    axis: np.ndarray,
    aside: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> RecordedMotion:
    """A mouse motion along the needle: legs of (seconds, mm from the start), in steps of page frames.

    aside: mm, by which the needle moves sideways in the first 0.8 s.
    """
    times = np.cumsum([0.0, *[seconds for seconds, _ in legs]])
    frames = np.arange(0, times[-1], 1 / HERTZ)
    way = np.interp(frames, times, [0.0, *[mm * 1e-3 for _, mm in legs]])
    sideways = np.outer(np.clip(frames / 0.8, 0, 1), np.asarray(aside) * 1e-3)
    return RecordedMotion(frames, np.asarray(exercise.start_position) + np.outer(way, axis) + sideways)


@cache
def hand_run(name: str, legs: tuple[tuple[float, float], ...], upright: bool = False, seed: int = 0) -> Columns:
    exercise = load_exercise(name)
    axis = unit(exercise.scene.membranes[0].inward_normal) if upright else np.asarray(exercise.start_axis)
    motion = motion_of(exercise, list(legs), axis)
    duration = sum(seconds for seconds, _ in legs)
    return experiment(as_a_device_runs_it(exercise.scene), motion, duration, axis, seed)


def judged(
    exercise: Exercise,
    columns: Columns,
    cuts: int | Iterable[int] = 160,
    scene: pn.Scene | None = None,
    second_device: bool = False,
    simulated: bool = False,
) -> Attempt:
    """cuts: ticks in a batch, or where batches begin. A page gets 27 at once; larger ones take less time."""
    attempt = Attempt(exercise, scene or as_a_device_runs_it(exercise.scene), second_device, simulated)
    for batch in cut(columns, range(0, len(columns["depth"]), cuts) if isinstance(cuts, int) else cuts):
        attempt.add(batch)
    return attempt


def cuts_near(time: float, rate: float, ticks: int) -> list[int]:
    """Where batches of one to three ticks begin within 0.4 s of a time, and larger ones elsewhere."""
    near = round(time * rate)
    small = [near + k for k in range(round(-0.4 * rate), round(0.4 * rate)) if k % 6 in (0, 1, 3)]
    return sorted({*range(0, ticks, 160), *small})


def tried(name: str, *legs: tuple[float, float], upright: bool = False, seed: int = 0) -> Result:
    """An attempt by a simulated hand."""
    return judged(load_exercise(name), hand_run(name, legs, upright, seed)).finish()


def ideal(scene: pn.Scene, *corners: tuple[float, float, float], speed: float = 10e-3, stops: float = 0.0) -> Columns:
    """A needle that moves from corner to corner (mm) at constant speed, perpendicular to the membranes, without lag.

    stops: rest at the end, s.
    """
    rate = scene.servo.rate
    parts = []
    for a, b in itertools.pairwise(np.asarray(corners) * 1e-3):
        n = max(1, round(float(np.linalg.norm(b - a)) / speed * rate))
        parts.append(a + np.outer(np.arange(n) / n, b - a))
    end = np.asarray(corners[-1]) * 1e-3
    position = np.concatenate([*parts, np.tile(end, (1 + round(stops * rate), 1))])
    return of_positions(scene, position)


def of_positions(scene: pn.Scene, position: np.ndarray) -> Columns:
    n, m = len(position), len(scene.membranes)
    normals = np.array([unit(p.inward_normal) for p in scene.membranes])
    depth = np.stack([(position - p.point) @ k for p, k in zip(scene.membranes, normals, strict=True)], axis=1)
    force: Callable[[int], np.ndarray] = lambda i: pn.ThickLaw(  # noqa: E731
        scene.needle, scene.membranes[i].membrane
    ).bounds(depth[:, i])[0]
    lower = np.stack([force(i) for i in range(m)], axis=1)
    return {
        "tick": np.arange(n),
        "time": np.arange(n) / scene.servo.rate,
        "tip": position,
        "axis": np.tile(normals[0], (n, 1)),
        "depth": depth,
        "phase": np.where(depth > 0, Phase.sliding_in.value, Phase.outside.value).astype(np.uint8),
        "axial_force": lower,
        "lower": lower,
        "direction": np.tile(normals, (n, 1, 1)),
        "model_force": np.einsum("nm,mk->nk", lower, normals),
        "fault": np.zeros(n, dtype=np.uint8),
        "commands": np.zeros(n, dtype=np.uint32),
    }


def goal(kind: str, **keys: object) -> str:
    """A table of an exercise file."""
    values = {key: f'"{v}"' if isinstance(v, str) else str(v).lower() for key, v in keys.items()}
    return "\n".join(["[[goal]]", f'kind = "{kind}"', *[f"{key} = {value}" for key, value in values.items()], ""])


HEAD = """
title = "Test"
description = "A test."
instruction = "Do it."
scene = "venipuncture"
[start]
position_mm = [0, 5, 0]
[space]
name = "the vein"
behind = "front vein wall"
in_front_of = "back vein wall"
sign = "the flash-back"
"""


def without(columns: Columns, start: int, end: int) -> Columns:
    """Without these ticks: their readings are missing."""
    keep = np.ones(len(columns["tick"]), dtype=bool)
    keep[start:end] = False
    return {name: column[keep] for name, column in columns.items()}


def late(columns: Columns, *stalls: tuple[int, float]) -> Columns:
    """The same ticks of a computer that is busy before some of them: (tick, s). On a simulated device nothing moves
    meanwhile."""
    time = columns["time"].copy()
    for tick, seconds in stalls:
        time[tick:] += seconds
    return columns | {"time": time}

"""Runs many trials of a scene on all processors."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from numbers import Real

import numpy as np
import numpy.typing as npt

from punctura._core import Hand, Plant, RecordedMotion, Scene, Strokes, real_numbers, run_scenes
from punctura.batches.inputs import enough_memory, whole_seeds
from punctura.batches.result import BatchResult
from punctura.errors import ConfigurationError
from punctura.progress import Progress


def batch(
    scene: Scene | Sequence[Scene],
    motion: Strokes | RecordedMotion | npt.ArrayLike,
    *,
    vary: Mapping[str, npt.ArrayLike] | None = None,
    trials: int | None = None,
    seeds: int | npt.ArrayLike = 0,
    duration: float | None = None,
    axis: npt.ArrayLike | None = None,
    plant: Plant | None = None,
    hand: Hand | None = None,
    keep_force: bool = False,
    threads: int | None = None,
    instructions: str | None = None,
    progress: Progress = None,
) -> BatchResult:
    """Runs many trials and returns the numbers of each.

    scene: one, or one for each trial; these may differ only in their numbers. motion: Strokes or a RecordedMotion of
    a hand that holds a simulated device, as in Experiment; or positions, m, (ticks, 3) for all trials or
    (trials, ticks, 3), as in Insertion.run. vary: values by path, SI, one for each trial (`grid` combines some):
    "membrane[0].friction", "hand.stiffness", "plant.mass", "strokes.duration". seeds: of each trial, or of the first
    one; then they count up. duration: s; default: as long as the motion. axis: direction of the needle; default: the
    first membrane's inward normal. keep_force: also returns the model's force of each tick. threads: default: one for
    each processor. instructions: "avx512", "avx2", "sse2", "neon" or "portable"; default: the fastest, or the
    environment variable PUNCTURA_SIMD. Each trial has the numbers of the same trial alone. Raises
    ConfigurationError, ValueError, TypeError, and MemoryError before it takes more memory than there is.
    """
    base, values = _numbers(scene)
    for path, column in (vary or {}).items():
        if not isinstance(path, str):
            raise TypeError(f"vary: a path is a text such as 'membrane[0].friction', not {path!r}")
        if path in values:
            raise ValueError(f"vary has {path}, in which the scenes differ, too: give it in one of them")
        values[path] = np.ascontiguousarray(np.atleast_1d(real_numbers(column, f"vary: {path}")))
        if values[path].size == 0:
            raise ValueError(f"vary: {path} is empty: give one value for each trial")
    if not isinstance(motion, Strokes | RecordedMotion):
        motion = real_numbers(motion, "motion")
        for name, given in {"duration": duration, "plant": plant, "hand": hand}.items():
            if given is not None:
                raise ValueError(f"{name} is for a simulated hand; motion is positions, which need none")
    n = _trials(values, seeds, trials, None if isinstance(scene, Scene) else len(scene), motion)
    if duration is not None and not (isinstance(duration, Real) and math.isfinite(duration) and duration >= 0):
        raise ValueError(f"duration must be 0 s or more, not {duration!r}")
    if keep_force and isinstance(motion, Strokes | RecordedMotion) and (duration is None or "servo.rate" in values):
        raise ValueError("keep_force needs a duration and one servo.rate, so that all trials have as many ticks")
    _warn_of_units(base, values)
    _room(base, motion, n, len(values), duration, keep_force)
    for path, column in values.items():
        if column.shape not in ((n,), (1,)):
            raise ValueError(f"vary: {path} has shape {column.shape}; there are {n} trials")
        values[path] = np.ascontiguousarray(np.broadcast_to(column, (n,)))
    own = whole_seeds(seeds, n)
    plant, hand = plant or Plant(), hand or Hand()
    direction = base.membranes[0].inward_normal if axis is None else real_numbers(axis, "axis")
    if isinstance(motion, Strokes | RecordedMotion) and np.shape(direction) != (3,):
        raise ValueError(f"axis has the shape {np.shape(direction)}; with a simulated hand it needs (3,)")
    found = run_scenes(
        base,
        motion,
        values,
        n,
        direction,
        plant,
        hand,
        own,
        math.nan if duration is None else duration,
        keep_force,
        threads,
        instructions,
        progress,
    )
    found["in_lanes"] = found["in_lanes"].view(np.bool_)
    kept = tuple(float(x) for x in np.ravel(direction)[:3])
    return BatchResult(**found, vary=values, seeds=own, base=base, motion=motion, plant=plant, hand=hand, axis=kept)


def _warn_of_units(scene: Scene, values: Mapping[str, npt.NDArray[np.float64]]) -> None:
    """Lets a scene with the extremes of each column warn of values of an unusual size, such as millimetres."""
    of_scene = {one.path for one in scene.fields()}
    for path, column in values.items():
        if path in of_scene and np.isfinite(column).all():
            for extreme in {float(column.min()), float(column.max())}:
                with suppress(ConfigurationError):  # the check of the trials names it
                    scene.with_values({path: extreme})


def _numbers(scene: Scene | Sequence[Scene]) -> tuple[Scene, dict[str, npt.NDArray[np.float64]]]:
    """The first scene, and the numbers in which the others differ from it."""
    if isinstance(scene, Scene):
        return scene, {}
    scenes = list(scene) if isinstance(scene, Sequence) else [scene]
    if isinstance(scene, str) or not all(isinstance(each, Scene) for each in scenes):
        raise TypeError(f"scene must be a Scene or a list of Scenes, not {scene!r}; load_scene() makes one")
    if not scenes:
        raise ValueError("scene: give at least one")
    base = scenes[0]
    numbers = [{one.path: one.value for one in each.fields()} for each in scenes]
    for i, each in enumerate(scenes):
        same = numbers[i].keys() == numbers[0].keys()
        if not same or base.replace(name=each.name).with_values(numbers[i]) != each:
            raise ValueError(
                f"scene[{i}] differs from scene[0] in more than its numbers (scene.fields()): run it in another batch"
            )
    columns = {path: np.array([each[path] for each in numbers]) for path in numbers[0]}
    return base, {path: column for path, column in columns.items() if np.ptp(column) > 0}


def _trials(
    values: Mapping[str, npt.NDArray[np.float64]],
    seeds: int | npt.ArrayLike,
    trials: int | None,
    scenes: int | None,
    motion: Strokes | RecordedMotion | npt.NDArray[np.float64],
) -> int:
    """The number of trials that the arguments ask for. Raises ValueError."""
    if trials is not None and (not isinstance(trials, int | np.integer) or trials < 1):
        raise ValueError(f"trials must be a whole number, 1 or more, not {trials!r}")
    counts = {"trials": trials} if trials is not None else {}
    if scenes is not None:
        counts["scene"] = scenes
    counts |= {path: len(column) for path, column in values.items() if len(column) > 1}
    if np.ndim(seeds) == 1:
        counts["seeds"] = len(np.asarray(seeds))
    if not isinstance(motion, Strokes | RecordedMotion) and motion.ndim == 3:
        counts["motion"] = len(motion)
    if len(set(counts.values())) > 1:
        listed = ", ".join(f"{name}: {count}" for name, count in counts.items())
        raise ValueError(f"the arguments ask for different numbers of trials ({listed})")
    return next((count for count in counts.values() if count is not None), 1)


def _room(
    scene: Scene,
    motion: Strokes | RecordedMotion | npt.NDArray[np.float64],
    trials: int,
    varied: int,
    duration: float | None,
    keep_force: bool,
) -> None:
    """Raises MemoryError if the results have no room."""
    ticks = 0.0
    if keep_force and not isinstance(motion, Strokes | RecordedMotion):
        ticks = float(motion.shape[-2]) if motion.ndim > 1 else 0.0
    elif keep_force:
        ticks = (duration or 0.0) * scene.servo.rate
    needed = trials * (200.0 + 24 * varied + 64 * len(scene.membranes) + 24 * ticks)
    forces = f" with the force of each of {ticks:.0f} ticks" if keep_force else ""
    advice = "Take fewer trials at a time" + (", or leave out keep_force." if keep_force else ".")
    enough_memory(needed, f"{trials} trials{forces}", advice)

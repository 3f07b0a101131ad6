"""Simulates a motion in memory."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from punctura._core import Insertion, Rival, RivalInsertion, Scene
from punctura.progress import Progress
from punctura.simulation.columns import MotionError
from punctura.simulation.resample import Evenness, resampler_for, unit, with_axis
from punctura.simulation.summary import depth_note
from punctura.ticks import Ticks

Array = npt.NDArray[np.float64]


def simulate_arrays(
    scene: Scene,
    position: npt.ArrayLike,
    time: npt.ArrayLike | None,
    axis: npt.ArrayLike | None,
    progress: Progress = None,
    rivals: Sequence[Rival] | None = None,
) -> Ticks:
    """See simulate."""
    normal = np.asarray(scene.membranes[0].inward_normal, dtype=np.float64)
    normal = normal / np.linalg.norm(normal)
    for name, given in (("position", position), ("time", time), ("axis", axis)):
        if np.ma.is_masked(given):
            raise ValueError(f"{name} has masked elements: fill them in, or leave these rows out")
        if given is not None and (kind := np.asarray(given).dtype).kind not in "biufO":
            raise TypeError(f"{name} must hold real numbers, not {'text' if kind.kind in 'US' else kind}")
    p = np.asarray(position, dtype=np.float64)
    if p.ndim == 1:  # depths below the first membrane's surface
        p = np.asarray(scene.membranes[0].point) + p[:, None] * normal
    if p.ndim != 2 or p.shape[1] != 3:
        raise ValueError(f"position must have shape (n, 3), m, or (n,), depths in m, not {p.shape}")
    b = normal if axis is None else np.asarray(axis, dtype=np.float64)
    if b.shape not in ((3,), p.shape):
        raise ValueError(f"axis must have shape (3,) or {p.shape}, not {b.shape}")
    _check_rows("position", p, np.isfinite(p).all(axis=1), "must be finite")
    directions = np.atleast_2d(b)
    _check_rows("axis", directions, np.isfinite(directions).all(axis=1), "must be finite")
    _check_rows("axis", directions, directions.any(axis=1), "must be a direction: at least one of its numbers not 0")
    stamps = np.arange(len(p)) / scene.servo.rate
    if time is not None:
        stamps, p, b = _resampled(scene, np.asarray(time, dtype=np.float64), p, b)
    names = [placed.name for placed in scene.membranes]
    insertion = Insertion(scene) if rivals is None else RivalInsertion(scene, rivals)
    ticks = insertion.run(p, b, progress=progress)
    deepest = ticks.depth.max(axis=0) if len(p) else np.zeros(1)
    if note := depth_note(names[int(deepest.argmax())], float(deepest.max())):
        warnings.warn(note, UserWarning, stacklevel=3)  # the line that calls simulate
    return Ticks({"tick": np.arange(len(p), dtype=np.uint64), "time": stamps, **dict(ticks.items())}, names)


def _check_rows(name: str, rows: Array, good: Any, rule: str) -> None:
    bad = np.flatnonzero(~good)
    if len(bad):
        raise ValueError(f"{name}[{bad[0]}] {rule} and holds {rows[bad[0]]}")


def _resampled(scene: Scene, time: Array, position: Array, axis: Array) -> tuple[Array, Array, Array]:
    """Time, position and axis at the servo rate. Raises ValueError for an invalid time."""
    if time.shape != (len(position),):
        raise ValueError(f"time must have shape ({len(position)},), one for each position, not {time.shape}")
    if not np.isfinite(time).all():
        raise ValueError(f"time[{int(np.flatnonzero(~np.isfinite(time))[0])}] is not a finite number")
    if not len(time):
        return time, position, axis
    even = Evenness(Path("time"))
    try:
        even.add(0, time)
        even.finish()
        resampler = resampler_for(even, scene.servo.rate)
    except MotionError as bad:
        raise ValueError(f"time[{bad.line}]: {bad.what}" if bad.line else f"time: {bad.what}") from None
    if resampler is None:
        return time, position, axis
    rows = position if axis.ndim == 1 else with_axis(position, axis)
    stamps, values = zip(*resampler.add(rows), strict=True)
    new_time, rows = np.concatenate(stamps), np.concatenate(values)
    return new_time, rows[:, :3], axis if axis.ndim == 1 else unit(rows[:, 3:])

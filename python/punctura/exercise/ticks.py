"""Where the tip is among the membranes, tick by tick."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from punctura import Scene
from punctura._core import Phase, grazing_cosine, tip_length
from punctura.ticks import Columns

Numbers = NDArray[np.float64]
Flags = NDArray[np.bool_]

# By phase: whether the membrane holds the needle.
_INSIDE = np.zeros(256, dtype=np.bool_)
_INSIDE[[Phase.sticking.value, Phase.sliding_in.value, Phase.sliding_out.value]] = True
_COMMAND_SCENE = 8
ROUNDING = 1e-12  # m


@dataclass
class Ticks:
    """n ticks, m membranes. Depths are those of the model: a wall that gives way is not yet pierced."""

    tick: NDArray[np.int64]
    time: Numbers  # s
    tip: Numbers  # (n, 3), m
    held: Numbers  # (n, 3), the needle's direction: that held by the first membrane, else the stylus's
    force: Numbers  # N, the norm of the model's force; NaN where it is not known
    fault: NDArray[np.int64]
    limit: NDArray[np.int64]  # that cut the force to the device: Limit, or another number where that is not known
    new_scene: Flags
    inside: Flags  # (n, m), held by the membrane: the model lets it in
    depth: Numbers  # (n, m), of the point along the needle while inside, else along the normal, m
    below: Numbers  # (n, m), of the point along the normal, m
    run_on: Numbers  # (n, m), how far the slanted face is past the membrane along the needle, m; below 0 before that
    past: Numbers  # (n, m), how far the point is behind the membrane's far face, along its normal, m
    tip_past: Numbers  # (n, m), how far the end of the slanted face is
    # Of the point, and of the whole tip, (n, 2): filled in by Stays.
    in_space: Flags
    stay: Numbers  # s since it came into the space where it is now; 0 outside
    dwell: Numbers  # s in the space so far, in all

    def __len__(self) -> int:
        return len(self.tick)

    @property
    def point_behind(self) -> Flags:
        """(n, m), the point is out behind the membrane; not where that is not known."""
        return self.past > 0

    @property
    def tip_behind(self) -> Flags:
        """(n, m), the slanted face is, too."""
        return self.tip_past >= -ROUNDING

    def part(self, rows: slice) -> Ticks:
        return Ticks(*(getattr(self, field.name)[rows] for field in fields(self)))


class Geometry:
    """A scene's membranes, for judging a tip."""

    def __init__(self, scene: Scene) -> None:
        normals = np.array([placed.inward_normal for placed in scene.membranes], dtype=np.float64)
        self.normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        self.thickness = np.array([placed.membrane.thickness for placed in scene.membranes], dtype=np.float64)
        self.tip_length = tip_length(scene.needle)
        self._rate = scene.servo.rate

    def ticks(self, columns: Columns, first: int = 0) -> Ticks:
        """A batch of snapshots. first: the number of its first tick, where it does not tell."""
        m = len(self.thickness)
        depth = _wide(columns["depth"], m, np.nan)
        n = len(depth)
        finite = np.isfinite(depth)
        inside = _INSIDE[_wide(columns["phase"], m, 255)] & finite
        axis = _rows(columns.get("axis"), n)
        cosine = self._cosine(columns, axis, inside)
        below = np.where(inside, depth * cosine, depth)
        tick = columns["tick"].astype(np.int64) if "tick" in columns else np.arange(first, first + n)
        force = columns["model_force"] if "model_force" in columns else columns["force"]
        zeros = np.zeros(n, dtype=np.int64)
        time = np.asarray(columns["time"] if "time" in columns else tick / self._rate, dtype=np.float64)
        return Ticks(
            tick=tick,
            time=time,
            tip=columns["tip"],
            held=self._held(columns, axis, inside),
            force=np.linalg.norm(force, axis=1),
            fault=columns["fault"].astype(np.int64) if "fault" in columns else zeros,
            limit=columns["limit"].astype(np.int64) if "limit" in columns else zeros,
            new_scene=(columns.get("commands", zeros).astype(np.int64) & _COMMAND_SCENE) != 0,
            inside=inside,
            depth=depth,
            below=below,
            run_on=np.where(inside, depth - self.tip_length - self.thickness / cosine, -np.inf),
            past=below - self.thickness,
            tip_past=below - self.thickness - self.tip_length * cosine,
            in_space=np.zeros((n, 2), dtype=np.bool_),
            stay=np.zeros((n, 2)),
            dwell=np.zeros((n, 2)),
        )

    def _held(self, columns: Columns, axis: Numbers, inside: Flags) -> Numbers:
        held = axis
        if "direction" in columns and columns["direction"].shape[1]:
            b = columns["direction"][:, 0]
            held = np.where(inside[:, :1] & np.isfinite(b).all(axis=1, keepdims=True), b, axis)
        length = np.linalg.norm(held, axis=1, keepdims=True)
        good = np.isfinite(length) & (length > 0)
        return np.where(good, held / np.where(good, length, 1.0), self.normals[0])

    def _cosine(self, columns: Columns, axis: Numbers, inside: Flags) -> Numbers:
        """n.b: by the direction held since entry; where the tip is not inside, by the stylus."""
        cosine = axis @ self.normals.T
        if "direction" in columns:
            m = len(self.thickness)
            held = np.einsum("nmk,mk->nm", _wide(columns["direction"], m, np.nan), self.normals)
            cosine = np.where(inside & np.isfinite(held), held, cosine)
        return np.clip(np.where(np.isfinite(cosine), cosine, 1.0), grazing_cosine, 1.0)


def _rows(column: NDArray[Any] | None, n: int) -> Numbers:
    return np.full((n, 3), np.nan) if column is None else np.asarray(column, dtype=np.float64)


def _wide(column: NDArray[Any], m: int, none: float) -> NDArray[Any]:
    """For m membranes: more are left out, missing ones are none."""
    has = column.shape[1]
    if has >= m:
        return column[:, :m]
    shape = (column.shape[0], m - has, *column.shape[2:])
    return np.concatenate([column, np.full(shape, none, dtype=column.dtype)], axis=1)

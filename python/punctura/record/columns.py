"""Names of a recording's columns, and how a batch of snapshots is laid out under them.

A snapshot's fields become flat columns: a vector one for each axis, a membrane's field one for each membrane, by the
names that `punctura simulate` gives them. A field that has no name here is recorded under its own.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from punctura._core import Fault, Limit, Phase, ServoState
from punctura.record.errors import RecordingError

Columns = dict[str, NDArray[Any]]

LOST = "lost"  # ticks that are missing between the row before and this one
NEW_SCENES = "new_scenes"  # the scenes taken before this tick's step, as TOML; null in most rows

AXES = ("x", "y", "z")
_SCALARS = {"time": "time_s", "ceiling": "ceiling_N"}
_VECTORS = {
    "position": "{}_m",
    "axis": "axis_{}",
    "force": "f{}_N",
    "model_force": "model_f{}_N",
    "tip": "tip_{}_m",
}
_MEMBRANE = {"depth": "depth_{}_m", "axial_force": "force_{}_N", "lower": "lower_{}_N", "upper": "upper_{}_N"}
_MEMBRANE_VECTORS = {"proxy": "proxy_{}_{}_m", "direction": "direction_{}_{}"}
# What a person looks for first stands first.
_ORDER = ("tick", "time", "position", "axis", "force", "membranes", "model_force", "tip", "state", "fault", "limit",
          "commands")  # fmt: skip

WORDS = {
    "state": [ServoState(i).name for i in range(len(ServoState))],
    "fault": [Fault(i).name for i in range(len(Fault))],
    "limit": [Limit(i).name for i in range(len(Limit))],
    "phase": [Phase(i).name for i in range(len(Phase))],
}


def words_of(column: str) -> list[str] | None:
    """The words that a column's numbers stand for, by their value; None for a column of plain numbers."""
    return WORDS.get("phase" if column.startswith("phase_") else column)


def membrane_count(snapshots: Columns) -> int:
    """Of a batch: the most that any of its ticks had."""
    return int(snapshots["depth"].shape[1])


def flatten(snapshots: Columns, membranes: int) -> Columns:
    """The flat columns of a batch, for so many membranes. Those that a tick does not have are NaN, its phase 255."""
    n = len(snapshots["tick"])
    has = membrane_count(snapshots)
    first = [name for name in _ORDER if name == "membranes" or name in snapshots]
    each = [name for name, column in snapshots.items() if _per_membrane(name, column)]
    rest = [name for name in snapshots if name not in first and name not in each]
    flat: Columns = {}
    for name in first + rest:
        if name != "membranes":
            flat.update(_flat(name, snapshots[name]))
            continue
        for i in range(membranes):
            for field in each:
                columns = snapshots[field]
                flat.update(_flat_membrane(field, i, columns[:, i] if i < has else _none(columns, n)))
            if i < has:
                absent = np.isnan(flat[f"depth_{i}_m"])
                flat[f"phase_{i}"] = np.where(absent, np.uint8(255), flat[f"phase_{i}"])
    return flat


def _per_membrane(name: str, column: NDArray[Any]) -> bool:
    return column.ndim == 3 or (column.ndim == 2 and name not in _VECTORS and name in {*_MEMBRANE, "phase"})


def _none(columns: NDArray[Any], n: int) -> NDArray[Any]:
    none = np.nan if columns.dtype.kind == "f" else 255
    return np.full((n, *columns.shape[2:]), none, dtype=columns.dtype)


def _flat(name: str, column: NDArray[Any]) -> Columns:
    if name == "healthy":
        column = column.astype(np.bool_)
    if column.ndim == 1:
        return {_SCALARS.get(name, name): column}
    if column.shape[1] == 3:
        pattern = _VECTORS.get(name, name + "_{}")
        return {pattern.format(a): column[:, k] for k, a in enumerate(AXES)}
    return {f"{name}_{k}": column[:, k] for k in range(column.shape[1])}


def _flat_membrane(name: str, i: int, column: NDArray[Any]) -> Columns:
    if column.ndim == 1:
        return {_MEMBRANE.get(name, name + "_{}").format(i): column}
    pattern = _MEMBRANE_VECTORS.get(name, name + "_{}_{}")
    return {pattern.format(i, a): column[:, k] for k, a in enumerate(AXES)}


class Inputs(NamedTuple):
    """What a tick was given: with it, a scene and the limits, its force can be computed again."""

    sequence: NDArray[np.uint64]
    time: NDArray[np.float64]
    position: NDArray[np.float64]
    axis: NDArray[np.float64]
    buttons: NDArray[np.uint32]
    healthy: NDArray[np.uint8]
    motor_temperature: NDArray[np.float64]
    commands: NDArray[np.uint32]


def inputs_of(flat: Columns) -> Inputs:
    """The inputs among flat columns. Raises RecordingError where one is missing."""

    def column(name: str, kind: type[np.generic]) -> NDArray[Any]:
        if name not in flat:
            raise RecordingError(f"the recording has no column {name}, which a replay needs")
        return np.ascontiguousarray(flat[name], dtype=kind)

    def vector(name: str) -> NDArray[np.float64]:
        return np.stack([column(_VECTORS[name].format(a), np.float64) for a in AXES], axis=1)

    return Inputs(
        column("sequence", np.uint64),
        column("time_s", np.float64),
        vector("position"),
        vector("axis"),
        column("buttons", np.uint32),
        column("healthy", np.uint8),
        column("motor_temperature", np.float64),
        column("commands", np.uint32),
    )

"""Reads a trace from a file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from punctura._core import Needle
from punctura.record import Recording, RecordingError, open_recording
from punctura.record.schema import ticks_of
from punctura.trace.columns import choose_columns, unit_size
from punctura.trace.decimals import Decimal
from punctura.trace.findings import examine
from punctura.trace.size import check_file, check_size
from punctura.trace.tables import Table, read_table
from punctura.trace.trace import Finding, Trace, TraceError

Array = NDArray[np.float64]
Order = Literal["recorded", "depth"]


def read_trace(
    path: str | os.PathLike[str],
    columns: Mapping[str, str | int] | None = None,
    units: Mapping[str, str] | None = None,
    *,
    order: Order = "recorded",
    decimal: Decimal | None = None,
) -> Trace:
    """Reads CSV, Parquet, MAT, XLSX or a recording of Punctura. The findings of the trace name what is unusual.

    columns: {"depth": name or number from 1, "force": ..., "time": ...}; without it, columns are found by name
    (`depth_mm`, `force_N`, `time_s`). units: {"depth": "mm", ...}; a unit in a column's name needs none.
    order: "depth" sorts a digitised curve of one insertion. decimal: the mark in front of decimals in a text file;
    None: as the file shows, and a number that can be read in two ways is an error. Raises TraceError, OSError.
    """
    path = Path(path)
    check_file(path)
    recording = recording_at(path)
    if recording is not None:
        return examine(_from_recording(recording))
    table = read_table(path, decimal)
    return examine(_from_table(table, str(path), columns, units, order))


def recording_at(path: Path) -> Recording | None:
    """The recording of Punctura in a file; None for another file. Raises OSError."""
    try:
        return open_recording(path)
    except RecordingError:
        return None


def recorded_needle(path: Path) -> Needle | None:
    """The needle that a file states: only a recording does. Raises OSError."""
    recording = recording_at(path)
    return None if recording is None else recording.info.scene.needle


def _from_recording(recording: Recording) -> Trace:
    """Batch by batch, because all columns of a recording need many times the memory of a trace."""
    path = recording.path
    check_size(path, recording.rows, 3)
    first, parts = None, [np.empty((0, 3))]
    for batch in recording.batches():
        ticks = ticks_of(batch)
        first = ticks.position[0] if first is None else first
        axis = ticks.axis / np.linalg.norm(ticks.axis, axis=1, keepdims=True)
        depth = np.sum((ticks.position - first) * axis, axis=1)
        parts.append(np.column_stack((depth, -np.sum(ticks.force * axis, axis=1), ticks.time)))
    depth, force, time = np.concatenate(parts).T
    return Trace(depth, force, time, str(path))


def _from_table(
    table: Table,
    source: str,
    columns: Mapping[str, str | int] | None,
    units: Mapping[str, str] | None,
    order: Order,
) -> Trace:
    names = list(table)
    held = {
        role: table[names[i]] * unit_size(role, names[i], units, source)
        for role, i in choose_columns(names, columns, source).items()
    }
    found: list[Finding] = []
    good = np.all([np.isfinite(column) for column in held.values()], axis=0)
    if not good.all():
        count = int((~good).sum())
        text = f"{count} of {len(good)} rows hold no number in a column, the first is row {int(np.argmin(good)) + 1}"
        found.append(Finding("rows_without_numbers", f"{text}; they are left out", True))
    if good.sum() < 5:
        raise TraceError(
            f"{source}: a trace needs at least 5 rows with numbers in all columns, and here are {int(good.sum())}"
        )
    held = {role: column[good] for role, column in held.items()}
    if order == "depth":
        held = {
            role: column[np.argsort(held["depth"], kind="stable")] for role, column in held.items() if role != "time"
        }
    elif "time" in held:
        held = _with_growing_time(held, found)
        if (left := len(held["depth"])) < 5:
            raise TraceError(
                f"{source}: {found[-1].text}. A trace needs at least 5 samples, and {left} would be left: check which "
                "column is the time and in which order the rows are, or leave the time out"
            )
    return replace(Trace(held["depth"], held["force"], held.get("time"), source), findings=tuple(found))


def _with_growing_time(held: dict[str, Array], found: list[Finding]) -> dict[str, Array]:
    """Leaves out samples whose time does not grow, and says so."""
    time = held["time"]
    grows = np.concatenate(([True], time[1:] > np.maximum.accumulate(time)[:-1]))
    if grows.all():
        return held
    back = np.concatenate(([False], np.diff(time) < 0))
    row = int(np.argmin(grows)) + 1
    if back.any():
        text = f"time goes back {int(back.sum())} times, first at sample {int(np.argmax(back)) + 1}"
        severe = int((~grows).sum()) > len(time) // 10
        found.append(Finding("time_goes_back", f"{text}; {int((~grows).sum())} samples are left out", True, severe))
    else:
        text = f"{int((~grows).sum())} samples have the time of the sample before, first sample {row}"
        found.append(Finding("time_repeats", f"{text}; they are left out", True))
    return {role: column[grows] for role, column in held.items()}

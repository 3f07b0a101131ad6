"""Reads a trace from a file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from punctura._core import Needle
from punctura.record import Recording, RecordingError, open_recording
from punctura.record.columns import ticks_of
from punctura.trace.columns import choose_columns
from punctura.trace.decimals import Decimal
from punctura.trace.findings import examine
from punctura.trace.motion import Speeds, about_speed, depth_from, with_depth_between, with_depth_of
from punctura.trace.reading import Order, Reading
from punctura.trace.samples import no_reading
from punctura.trace.table import Table, check_file, check_size
from punctura.trace.tables import read_table
from punctura.trace.text import DecimalError
from punctura.trace.trace import Finding, Trace, TraceError, Unstated

Array = NDArray[np.float64]

_LATE = 1e4  # s: a time of day or since 1970, which then begins at 0
_BEGINS, _INSIDE = 3.0, 0.1  # usual steps of time or depth; of the range of the depth, from where the needle began


def read_trace(
    path: str | os.PathLike[str],
    columns: Mapping[str, str | int] | None = None,
    units: Mapping[str, str] | None = None,
    *,
    order: Order = "recorded",
    decimal: Decimal | None = None,
    encoding: str | None = None,
    sheet: str | None = None,
    speeds: Speeds = (),
    depth_file: str | os.PathLike[str] | None = None,
) -> Trace:
    """Reads a trace file; docs/identify.md lists the kinds. The findings of the trace name what is unusual.

    columns: {"depth": name or number from 1, "force": ..., "time": ...}; without it, columns are found by name
    (`depth_mm`, `force_N`, `time_s`). units: {"depth": "mm", ...}; a unit in a column's name needs none.
    order: "depth" sorts a digitised curve of one insertion. decimal: the mark in front of decimals in a text file, and
    encoding: of its letters; None: as the file shows, and what can be read in two ways is an error. sheet: of a
    workbook, by name or number from 1. speeds: of the needle, for a file without depth: from which time on (s since the
    first sample), how fast (m/s, inwards). depth_file: another file with depth and time, on the same clock; columns and
    units are of both files. Raises TraceError, RecordingError (damaged), OSError.
    """
    other = None if depth_file is None else os.fspath(depth_file)
    return read_as(path, Reading(columns or {}, units or {}, order, decimal, encoding, sheet, tuple(speeds), other))


def read_as(path: str | os.PathLike[str], reading: Reading) -> Trace:
    """As read_trace()."""
    path = Path(path)
    check_file(path)
    recording = recording_at(path)
    if recording is not None:
        return examine(_from_recording(recording))
    try:
        table = read_table(path, reading)
    except DecimalError as doubt:  # all questions at once
        try:
            _from_table(read_table(path, replace(reading, decimal=",")), str(path), reading)
        except Unstated as other:
            raise Unstated(f"{doubt}\n{other}", [*doubt.options, *other.options]) from None
        raise
    trace = _from_table(table, str(path), reading)
    return trace if any(finding.severe for finding in trace.findings) else examine(trace)


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
        depth, force = _along_axis(ticks.position - first, ticks.axis, ticks.force)
        parts.append(np.column_stack((depth, force, ticks.time)))
    depth, force, time = np.concatenate(parts).T
    return Trace(depth, force, time, str(path))


def _along_axis(way: Array, axis: Array, force: Array) -> tuple[Array, Array]:
    """Depth, m, and force against the insertion, N, along the needle, from vectors (n, 3)."""
    axis = axis / np.linalg.norm(axis, axis=1, keepdims=True)
    return np.sum(way * axis, axis=1), -np.sum(force * axis, axis=1)


_EXPORTED = ("x_m", "y_m", "z_m", "axis_x", "axis_y", "axis_z", "fx_N", "fy_N", "fz_N")


def _as_recorded(table: Table) -> Table:
    """The table; that of an exported recording with the depth and the force of the recording."""
    if not all(name in table for name in ("tick", "time_s", *_EXPORTED)):
        return table
    position, axis, force = np.column_stack([table[name] for name in _EXPORTED]).reshape(-1, 3, 3).swapaxes(0, 1)
    depth, along = _along_axis(position - position[0], axis, force)
    own = Table({"time_s": table["time_s"], "depth_m": depth, "force_N": along})
    own.findings = table.findings
    return own


def _from_table(table: Table, source: str, reading: Reading) -> Trace:
    named = {role: name for role, name in reading.columns.items() if role != "depth" or "depth" in reading.needed}
    table = table if named else _as_recorded(table)
    held, found = choose_columns(table, named, reading.units, source, reading.needed)
    found[:0] = table.findings
    for role in ("depth", "force"):
        empty = no_reading(held.get(role, np.empty(0)))
        if empty.any():
            values = " and ".join(f"{value:.6g}" for value in np.unique(held[role][empty]))
            text = f"{int(empty.sum())} rows hold {values} {'N' if role == 'force' else 'm'} for the {role}"
            text += ", far outside all other values"
            found.append(Finding("no_reading", f"{text}: this is taken for no reading", True))
            held[role] = np.where(empty, np.nan, held[role])
    held = _to_the_end(held, table, found)
    held = with_depth_between(held, found)
    good = np.all([np.isfinite(column) for column in held.values()], axis=0)
    if not good.all():
        count = int((~good).sum())
        lacking = " or ".join(role for role, column in held.items() if not np.isfinite(column).all())
        text = (
            f"{count} of {len(good)} rows hold no number for the {lacking}, the first is row {int(np.argmin(good)) + 1}"
        )
        severe = 10 * count > len(good)
        remedy = "these are too many to leave out; mend or delete them in the file" if severe else "they are left out"
        found.append(Finding("rows_without_numbers", f"{text}; {remedy}", not severe, severe))
    if good.sum() < 5:
        raise TraceError(
            f"{source}: a trace needs at least 5 rows with numbers in all columns, and here are {int(good.sum())}"
        )
    held = {role: column[good] for role, column in held.items()}
    if reading.order == "depth":
        held = {
            role: column[np.argsort(held["depth"], kind="stable")] for role, column in held.items() if role != "time"
        }
    elif "time" in held:
        held = _with_growing_time(held, found, "time" in reading.columns or "time" in reading.needed)
        if (left := len(held["force"])) < 5:
            raise TraceError(
                f"{source}: {found[-1].text}. A trace needs at least 5 samples, and {left} would be left: check which "
                "column is the time and in which order the rows are, or leave the time out"
            )
    if reading.depth_file is not None:
        held, more = with_depth_of(Path(reading.depth_file), held, reading, source)
        found += more
    elif reading.speeds:
        held["depth"] = depth_from(reading.speeds, held["time"])
        found.append(about_speed(reading.speeds, held["force"]))
    if "time" in held and abs(held["time"][0]) > _LATE:
        held["time"] = held["time"] - held["time"][0]
    return replace(Trace(held["depth"], held["force"], held.get("time"), source), findings=tuple(found))


def _to_the_end(held: dict[str, Array], table: Table, found: list[Finding]) -> dict[str, Array]:
    """Without the rows behind the last depth and force, if other columns, of other specimens, go on."""
    measured = np.any([np.isfinite(held[role]) for role in ("depth", "force") if role in held], axis=0)
    end = int(np.flatnonzero(measured)[-1]) + 1 if measured.any() else len(measured)
    if end == len(measured) or not np.any([np.isfinite(column[end:]) for column in table.values()], axis=0).all():
        return held
    text = f"the last {len(measured) - end} rows hold no depth and no force, and are left out"
    found.append(Finding("shorter", f"{text}: other columns of the file are longer", True))
    return {role: column[:end] for role, column in held.items()}


def _joined(held: dict[str, Array], found: list[Finding]) -> dict[str, Array]:
    """The time (n,) of a machine that begins each motion at 0, one after the other, where the needle goes on inside.

    In air, the next motion may be that of another specimen.
    """
    time, depth = held["time"], held.get("depth")
    pace = np.diff(time)
    back = np.flatnonzero(pace < 0) + 1
    if depth is None or not len(back) or len(time) < 5:
        return held
    usual, way, span = float(np.median(pace)), np.abs(np.diff(depth)), float(np.ptp(depth))
    begins = np.abs(time[back] - time[0]) <= _BEGINS * usual
    goes_on = way[back - 1] <= _BEGINS * float(np.percentile(way, 90))
    inside = np.abs(depth[back] - depth[0]) > _INSIDE * span
    if not (begins & goes_on & inside).all():
        return held
    steps = np.where(pace < 0, usual, pace)
    text = f"time begins again {len(back)} times, first at sample {int(back[0]) + 1}, and the depth goes on there"
    found.append(Finding("time_begins_again", f"{text}: the parts are taken for one motion, without a pause", True))
    return {**held, "time": time[0] + np.concatenate(([0.0], np.cumsum(steps)))}


def _with_growing_time(held: dict[str, Array], found: list[Finding], needed: bool) -> dict[str, Array]:
    """Leaves out samples whose time does not grow, and says so; a time that is too coarse as a whole if not needed."""
    held = _joined(held, found)
    time = held["time"]
    grows = np.concatenate(([True], time[1:] > np.maximum.accumulate(time)[:-1]))
    if grows.all():
        return held
    back = np.concatenate(([False], np.diff(time) < 0))
    row, lost = int(np.argmin(grows)) + 1, int((~grows).sum())
    if back.any():
        severe = lost > len(time) // 10
        text = f"time goes back {int(back.sum())} times, first at sample {int(np.argmax(back)) + 1}"
        advice = ". If several specimens stand one below the other, save each as a file" if severe else ""
        found.append(Finding("time_goes_back", f"{text}; {lost} samples are left out{advice}", True, severe))
    else:
        severe = lost > len(time) // 2  # a digitised trace often has two forces at a time; a coarse clock has many
        text = f"{lost} samples have the time of the sample before, first sample {row}"
        if severe and not needed:
            text += "; the trace is read without time. Record a finer one"
            found.append(Finding("time_repeats", text, True))
            return {role: column for role, column in held.items() if role != "time"}
        text += "; they are left out" + (". Record a finer time" if severe else "")
        found.append(Finding("time_repeats", text, True, severe))
    return {role: column[grows] for role, column in held.items()}

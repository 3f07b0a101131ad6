"""Reads TDMS files of LabVIEW, by npTDMS."""

from __future__ import annotations

import contextlib
import importlib
import logging
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from punctura.extras import optional
from punctura.trace.heading import unique, with_unit
from punctura.trace.reading import Reading, is_trace, only_trace, wanted_sheet
from punctura.trace.table import Table, check_size, unreadable
from punctura.trace.trace import Finding, TraceError

Array = NDArray[np.float64]


def read_tdms(path: Path, reading: Reading) -> Table:
    """The group that is stated, or the only one that can be a trace. Raises TraceError, OSError."""
    opened = optional("nptdms", "formats", f"{path}: a TDMS file").TdmsFile.open
    try:
        with _first_warning() as warned, opened(path) as file:
            names = [group.name for group in file.groups()]
            wanted = names if reading.sheet is None else [wanted_sheet(path, names, reading.sheet)]
            tables = {name: _table(path, file[name]) for name in wanted}
    except TraceError:
        raise
    except Exception as error:  # npTDMS raises many types for a damaged file
        raise unreadable(path, "TDMS", error) from None
    if warned and not any(is_trace(table, reading) for table in tables.values()):
        raise unreadable(path, "TDMS", ValueError(warned[0][:100]))  # its last channels are shorter, or not there
    found = only_trace(path, {name: table for name, table in tables.items() if table}, reading)
    if warned:
        text = f"the file seems damaged or cut off ({warned[0][:100]}); copy or export it again"
        found.findings.append(Finding("damaged", text))
    return found


@contextlib.contextmanager
def _first_warning() -> Iterator[list[str]]:
    """Takes the first warning of npTDMS, which else prints them all, with bytes of the file."""
    seen: list[str] = []
    handler = logging.Handler(logging.WARNING)
    handler.emit = lambda record: seen.append(record.getMessage()) if not seen else None  # type: ignore[method-assign]
    logger, console = logging.getLogger("nptdms"), importlib.import_module("nptdms.log").log_manager.console_handler
    level = console.level
    logger.addHandler(handler)
    console.setLevel(logging.CRITICAL + 1)
    try:
        yield seen
    finally:
        console.setLevel(level)
        logger.removeHandler(handler)


def _table(path: Path, group: Any) -> Table:
    """The longest channels of a group. A channel with an increment gives the time, if no channel is one.

    Shorter channels with an increment are interpolated at the times of the longest one.
    """
    channels = [channel for channel in group.channels() if channel.dtype.kind in "iufM"]
    rows = max(map(len, channels), default=0)
    check_size(path, rows, len(channels))
    fastest = next((at for at in map(_times, channels) if len(at) == rows), np.empty(0))
    columns = {}
    for channel in channels:
        own = _times(channel)
        slower = min(len(own), len(fastest)) > 1 and own[1] - own[0] > 1.001 * (fastest[1] - fastest[0])
        if len(channel) == rows or slower:
            held = channel.properties
            values, unit = channel[:], str(held.get("unit_string") or held.get("NI_UnitDescription", ""))
            if len(values) < rows:
                values = np.interp(fastest, own, values, left=np.nan, right=np.nan)
            if values.dtype.kind == "M":
                values, unit = (values - values[0]) / np.timedelta64(1, "s"), "s"
            columns[with_unit(channel.name, unit)] = np.asarray(values, np.float64)
    if len(fastest):
        columns.setdefault("time [s]", fastest)
    return Table(dict(zip(unique(columns), columns.values(), strict=True)))


def _times(channel: Any) -> Array:
    """The times of a waveform, s; none for a channel that is none."""
    held = channel.properties
    step = float(held.get("wf_increment", 0.0))
    return float(held.get("wf_start_offset", 0.0)) + step * np.arange(len(channel) if step else 0, dtype=np.float64)

"""Reads TDMS files of LabVIEW, by npTDMS."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from punctura.extras import optional
from punctura.trace.heading import unique, with_unit
from punctura.trace.reading import Reading
from punctura.trace.sheets import only_trace, wanted_sheet
from punctura.trace.size import check_size
from punctura.trace.table import Table
from punctura.trace.trace import TraceError
from punctura.trace.unreadable import unreadable


def read_tdms(path: Path, reading: Reading) -> Table:
    """The group that is stated, or the only one that can be a trace. Raises TraceError, OSError."""
    opened = optional("nptdms", "formats", f"{path}: a TDMS file").TdmsFile.open
    try:
        with opened(path) as file:
            names = [group.name for group in file.groups()]
            wanted = names if reading.sheet is None else [wanted_sheet(path, names, reading.sheet)]
            tables = {name: _table(path, file[name]) for name in wanted}
    except TraceError:
        raise
    except Exception as error:  # npTDMS raises many types for a damaged file
        raise unreadable(path, "TDMS", error) from None
    return only_trace(path, {name: table for name, table in tables.items() if table}, reading)


def _table(path: Path, group: Any) -> Table:
    """The longest channels of a group. A channel with an increment gives the time, if no channel is one."""
    channels = [channel for channel in group.channels() if channel.dtype.kind in "iufM"]
    rows = max(map(len, channels), default=0)
    check_size(path, rows, len(channels))
    columns = {}
    for channel in channels:
        if len(channel) == rows:
            values, unit = channel[:], str(channel.properties.get("unit_string", ""))
            if values.dtype.kind == "M":
                values, unit = (values - values[0]) / np.timedelta64(1, "s"), "s"
            columns[with_unit(channel.name, unit)] = np.asarray(values, np.float64)
            if step := float(channel.properties.get("wf_increment", 0.0)):
                columns.setdefault("time [s]", step * np.arange(rows, dtype=np.float64))
    return Table(dict(zip(unique(columns), columns.values(), strict=True)))

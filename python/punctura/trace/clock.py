"""Time as it stands on a clock: `12:30:00.010`, with or without a date, and stamps since 1970."""

from __future__ import annotations

import datetime
import re
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from punctura.trace.table import Table
from punctura.trace.units import split_name

Array = NDArray[np.float64]

_CLOCK = re.compile(
    r"\s*(?:\d{1,4}[-./]\d{1,2}[-./]\d{1,4}[T\s,]+|\d+ days?, )?(\d{1,3}):(\d{2})"
    r"(?::(\d{2}(?:[.,:]\d+)?))?\s*([AaPp])?\.?[Mm]?\.?\s*(?:Z|UTC|[+-]\d{2}:?\d{2})?\s*"
)
_MINUTES = re.compile(r"\s*(\d{1,3}):(\d{2}[.,]\d+)\s*")  # as a spreadsheet shows it
_NANOSECONDS = re.compile(r"(.*)(?:nano|n)sec(s?|onds)")  # ROS 2 and 1
_STAMP = "time [s]"
_DAY = 86400.0


def is_clock(cells: Sequence[Any]) -> bool:
    """Whether most of the cells are a time of day."""
    return bool(cells) and 2 * sum(_seconds(cell) is not None for cell in cells) > len(cells)


def clock_seconds(cells: Sequence[Any]) -> Array:
    """Times of day in s since midnight, growing also past the next one; NaN for other cells."""
    read = [_seconds(cell) for cell in cells]
    time = np.array([np.nan if value is None else value for value in read], np.float64)
    known = np.flatnonzero(np.isfinite(time))
    if len(known):
        days = np.cumsum(np.diff(time[known], prepend=time[known[0]]) < -_DAY / 2)
        time[known] += _DAY * days
    return time


def clock_column(name: str) -> str:
    """The name of a column of clock_seconds()."""
    return f"{split_name(name)[0]} [s]"


def is_stamp(time: Array) -> bool:
    """Whether a column holds nanoseconds since 1970, as ROS writes them: no other time has such numbers."""
    known = time[np.isfinite(time)]
    return len(known) > 0 and bool((known > 9e17).all() and (known < 5e18).all())


def join_stamp(table: Table) -> None:
    """Joins the whole seconds and the nanoseconds of a stamp of ROS, two columns, to a time in s from the first on."""
    for name in table:
        if (
            (found := _NANOSECONDS.fullmatch(name))
            and (whole := f"{found[1]}sec{found[2]}") in table
            and _STAMP not in table
        ):
            seconds, rest = table.pop(whole), table.pop(name)
            table[_STAMP] = seconds - np.nanmin(seconds) + 1e-9 * rest
            return


def _seconds(cell: Any) -> float | None:
    if isinstance(cell, (datetime.datetime, datetime.time, datetime.timedelta)):  # of a workbook
        cell = str(cell)
    if not isinstance(cell, str):
        return None
    if short := _MINUTES.fullmatch(cell):
        return 60 * int(short[1]) + float(short[2].replace(",", "."))
    found = _CLOCK.fullmatch(cell)
    if found is None:
        return None
    hours = int(found[1])
    if found[4]:
        hours = hours % 12 + 12 * (found[4] in "Pp")
    return 3600 * hours + 60 * int(found[2]) + float(re.sub("[,:]", ".", found[3] or "0"))

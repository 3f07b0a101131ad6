"""The largest table that a trace file may hold: a file of some kilobytes can expand to gigabytes."""

from __future__ import annotations

import stat
from collections.abc import Collection
from pathlib import Path

from punctura.trace.trace import TraceError

MOST_NUMBERS = 100_000_000  # rows times columns: 800 MB in memory
MOST_COLUMNS = 1_000
MOST_BYTES = 2_000_000_000  # of a file: 20 for each number
LONGEST_NAME = 200  # characters of a column's name


def check_file(path: Path) -> None:
    """Raises TraceError for a pipe or a device, which may never end, OSError. Call it before the file is opened."""
    mode = path.stat().st_mode
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise TraceError(f"{path}: is a pipe or a device; save the trace in a file")


def check_bytes(path: Path, most: int = MOST_BYTES, what: str = "") -> None:
    """Raises TraceError for a file of more than `most` bytes, OSError. what: it holds, after the number in the text."""
    size = path.stat().st_size
    if size > most:
        text = f"{path}: has {size / 1e9:,.1f} GB{what}; the limit is {most / 1e9:g} GB"
        raise TraceError(f"{text}. Export only depth, force and time, or fewer rows")


def check_size(path: Path, rows: int, columns: int) -> None:
    """Raises TraceError for too many columns, or too many numbers in all of them."""
    if columns > MOST_COLUMNS:
        text = f"{path}: has {columns:,} columns; the limit is {MOST_COLUMNS:,}"
        raise TraceError(f"{text}. Export only depth, force and time")
    if rows * columns > MOST_NUMBERS:
        text = f"{path}: holds {rows * columns:,} numbers or more"
        raise TraceError(f"{text}; the limit is {MOST_NUMBERS:,}. Export only depth, force and time, or fewer rows")


def check_names(path: Path, names: Collection[str]) -> None:
    """Raises TraceError for a name of a column that is too long."""
    for number, name in enumerate(names, 1):
        if len(name) > LONGEST_NAME:
            text = f"{path}: the name of column {number}, {name[:20]!r}..., has {len(name):,} characters"
            raise TraceError(f"{text}; the limit is {LONGEST_NAME}. Give it a shorter name")

"""The largest table that a trace file may hold: a file of some kilobytes can expand to gigabytes."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from punctura.trace.trace import TraceError

MOST_NUMBERS = 100_000_000  # rows times columns: 800 MB in memory
MOST_COLUMNS = 1_000
LONGEST_NAME = 200  # characters of a column's name


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

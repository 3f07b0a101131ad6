"""A table before its columns are known: how large it may be, and what is wrong where it cannot be read.

A file of some kilobytes can expand to gigabytes.
"""

from __future__ import annotations

import errno
import stat
from collections.abc import Collection, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from punctura.trace.trace import Finding, TraceError

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


class Table(dict[str, NDArray[np.float64]]):
    """Columns of one length by their names, which hold their units. A cell that holds no number is NaN."""

    def __init__(self, columns: Mapping[str, NDArray[np.float64]] | None = None) -> None:
        super().__init__(columns or {})
        self.findings: list[Finding] = []  # about the file
        self.unclear = ""  # why it is no trace, although it has the columns of one


_BEGINNINGS = {
    "Parquet": b"PAR1",
    "MAT": b"MATLAB",
    "XLSX": b"PK",
    "XLS": b"\xd0\xcf\x11\xe0",
    "HDF5": b"",
    "TDMS": b"TDS",
    "ROS bag": b"",
}


def unreadable(path: Path, kind: str, error: Exception) -> TraceError:
    """What is wrong with a file that is named as a `kind`, and what to do. error: the reader's.

    Raises OSError; also `error` itself if it is one of the system. Those of readers for damaged data have no number.
    """
    if isinstance(error, OSError) and error.errno not in (None, errno.EINVAL):  # EINVAL: a place before the file
        raise error
    with path.open("rb") as file:
        head = file.read(8)
    if not head:
        return TraceError(f"{path}: is empty; export or copy it again")
    if kind.startswith("XLS") and head.lstrip(b"\xef\xbb\xbf \r\n\t").startswith(b"<"):
        text = "is a page of HTML or XML, although its name ends in"
        return TraceError(f"{path}: {text} {path.suffix}. Open it in a spreadsheet program, and save it as XLSX or CSV")
    if not head.startswith(_BEGINNINGS[kind]):
        return TraceError(
            f"{path}: is no {kind} file, although its name ends in {path.suffix}. If it is another kind of file, give "
            "it that ending, for example .csv; else export it again"
        )
    cause = (str(error).splitlines() or [type(error).__name__])[0].rstrip(".")
    return TraceError(
        f"{path}: is damaged or cut off: it begins as {kind}, and the rest cannot be read ({cause}). Copy it again, or "
        "export it again"
    )

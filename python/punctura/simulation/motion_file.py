"""Reads a motion file in blocks of rows, so that a file of any length fits in memory."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import IO, NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.csv
from numpy.typing import NDArray

from punctura.simulation.columns import AXIS, MotionError, read_header, read_lines

BLOCK_BYTES = 2 << 20
KEPT_BYTES = 8 << 20  # of text, whose numbers take about as much
LONGEST_LINE = 1 << 16  # bytes

Array = NDArray[np.float64]


class Block(NamedTuple):
    """A block of rows of a motion, in SI units."""

    first_line: int
    bytes_read: int  # bytes of the file up to the end of this block
    time: Array  # (n,)
    position: Array  # (n, 3)
    axis: Array | None  # (n, 3), as in the file


class MotionFile:
    """The rows of a motion file. They can be read more than once."""

    def __init__(self, path: Path) -> None:
        self.path = path
        with path.open("rb") as file:
            header = file.readline(1 << 16)
            self.size = path.stat().st_size
            if not header:
                raise MotionError(path, 0, "is empty; it must hold a line of column names and the motion below it")
            self.columns = read_header(header, path)
            self._data_start = file.tell()
        self._kept: list[Block] | None = None

    @property
    def has_axis(self) -> bool:
        return set(AXIS) <= set(self.columns)

    def blocks(self) -> Iterator[Block]:
        """Yields the motion from its start, about 2 MB of text at a time. A file of up to 8 MB is parsed once."""
        if self._kept is not None:
            yield from self._kept
            return
        kept: list[Block] = []
        for block in self._read():
            if self.size <= KEPT_BYTES:
                kept.append(block)
            yield block
        if self.size <= KEPT_BYTES:
            self._kept = kept

    def _read(self) -> Iterator[Block]:
        line = 2
        with self.path.open("rb") as file:
            file.seek(self._data_start)
            for text in _whole_lines(file):
                if len(text) - text.rfind(b"\n", 0, -1) > LONGEST_LINE:
                    line += text.count(b"\n") - text.endswith(b"\n")
                    raise MotionError(self.path, line, f"has more than {LONGEST_LINE:,} bytes; write one row in a line")
                rows = self._numbers(text, line)
                axis = rows[:, 4:7] if self.has_axis else None
                yield Block(line, file.tell(), rows[:, 0], rows[:, 1:4], axis)
                line += len(rows)

    def _numbers(self, text: bytes, first_line: int) -> Array:
        rows = _fast_numbers(text, len(self.columns))
        return read_lines(text, first_line, self.columns, self.path) if rows is None else rows


def _whole_lines(file: IO[bytes]) -> Iterator[bytes]:
    """Yields blocks of complete lines, without blank lines at the end of the file."""
    rest = b""
    while read := file.read(BLOCK_BYTES):
        text = rest + read
        filled = len(text.rstrip())  # keep blank lines for later: they are an error only if another line follows
        cut = (text.find(b"\n", filled) + 1 or text.rfind(b"\n", 0, filled) + 1) if filled else 0
        if filled - cut > LONGEST_LINE:  # an endless line would fill the memory
            cut = filled
        if cut:
            yield text[:cut]
        rest = text[cut:]
    if rest.strip():
        yield rest.rstrip() + b"\n"


def _fast_numbers(text: bytes, columns: int) -> Array | None:
    """Parses a whole block at once. None if the block needs the slow reader."""
    names = [str(i) for i in range(columns)]
    try:
        table = pyarrow.csv.read_csv(
            pa.BufferReader(text),
            pyarrow.csv.ReadOptions(column_names=names, use_threads=False, block_size=len(text) + 1),
            pyarrow.csv.ParseOptions(ignore_empty_lines=False),
            pyarrow.csv.ConvertOptions(column_types=dict.fromkeys(names, pa.float64()), null_values=[]),
        )
    except pa.ArrowInvalid:
        return None
    if table.num_rows != text.count(b"\n"):
        return None
    rows = np.empty((table.num_rows, columns))
    for i in range(columns):
        rows[:, i] = table.column(i).to_numpy()
    return rows if np.isfinite(rows).all() else None

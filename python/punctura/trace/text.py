"""Reads a table of numbers from a text file: what programs and testing machines write as CSV or TXT."""

from __future__ import annotations

import csv
import io
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import zip_longest
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv
from numpy.typing import NDArray

from punctura.trace.cells import are_plain, column, unit_beside
from punctura.trace.decimals import Decimal, DoubtfulNumber, decimal_in, has_decimal_comma, numbers
from punctura.trace.encoding import encoding_of
from punctura.trace.heading import column_names, first_row, second_table, with_unit
from punctura.trace.lines import (
    LOOKED_AT,
    MOST_ABOVE,
    MOST_BYTES,
    Pieces,
    is_comment,
    is_lvm,
    joined,
    lvm_lines,
    read_lines,
    survey,
)
from punctura.trace.table import Table, check_bytes, check_size
from punctura.trace.trace import Finding, TraceError, Unstated
from punctura.trace.units import role_of

if TYPE_CHECKING:
    from _typeshed import WriteableBuffer

Array = NDArray[np.float64]

_DELIMITERS = (";", "\t", "|", ",")  # a comma may be the decimal point of the others
_BLOCK = 1 << 22  # bytes: more than a line has
_MOST_BROKEN = 1_000_000  # rows with another number of cells than the last ones


def read_text(path: Path, decimal: Decimal | None = None, encoding: str | None = None) -> Table:
    """All columns of a text file by name; a cell that holds no number is NaN. Raises TraceError, OSError.

    decimal: the mark in front of decimals; None: as the file shows, and a number that can be read in two ways is an
    error. encoding: of the letters; None: as the file shows.

    Lines above the table are left out, but for the names of the columns and their units. Rows with another number of
    cells are NaN.
    """
    check_bytes(path, MOST_BYTES, " of text")
    letters = encoding_of(path, encoding)
    pieces: Pieces = partial(read_lines, path, letters.name)
    if is_lvm(pieces):
        pieces = partial(lvm_lines, pieces)
    found = survey(pieces)
    if not found.rows:
        raise TraceError(f"{path}: is empty")
    delimiter = _delimiter(found.last)
    above_all = joined(found.first)
    head, tail = ([_spaced(line, delimiter) for line in lines] for lines in ([row for row, _ in above_all], found.last))
    check_size(path, 0, max(1 + line.count(delimiter) for line in head + tail if not is_comment(line)))
    last = [_cells(line, delimiter) for line in tail]
    width = Counter(len(row) for row in last).most_common(1)[0][0]
    check_size(path, found.rows, width)
    mark = decimal or decimal_in(zip_longest(*last))
    above = [[] if is_comment(line) else _cells(line, delimiter) for line in head]
    first = first_row(above, width, mark)
    if first == len(above):
        where = f"its first {MOST_ABOVE:,} lines hold" if found.rows > MOST_ABOVE else "it holds"
        wanted = f" of {width} cells, as at its end" if width > 1 else " in columns"
        raise TraceError(f"{path}: {where} no rows of numbers{wanted}; export the samples as a table, one row for each")
    empty = min(next((i for i, cell in enumerate(row[::-1]) if cell), width) for row in last)  # columns at the end
    headings = [(line, _words(line.lstrip("#% "), delimiter, width)) for line, _ in above_all[:first]]
    titles = [words for line, words in headings if not (is_comment(line) and len(words) < width)]  # without remarks
    names = column_names(titles, width, width - empty)
    rows = _Rows(pieces, delimiter, skip=sum(count for line, count in above_all[:first] if not is_comment(line)))
    cells, left_out = _parsed(path, rows, names, delimiter)
    table, columns = Table(), list[Array]()
    beside_all = {name: _unit_beside(name, cells[name]) for name in names}
    if all(name.isdigit() for name in names) and len({role_of(unit) for unit in beside_all.values()} - {""}) < 2:
        beside_all = {}  # `ft` may name a sensor
    try:
        for name, beside in zip(names, [*names[1:], None], strict=True):
            read: Array
            if are_plain(cells[name].slice(0, LOOKED_AT).to_pylist()):
                named, read = (
                    with_unit(name, beside_all.get(beside or "", "")),
                    _numbers(cells[name], mark, decimal is not None),
                )
            else:
                named, read = column(name, cells[name].to_pylist(), mark, decimal is not None)
            columns.append(read)
            table[named] = np.insert(read, left_out, np.nan)
    except DoubtfulNumber as doubt:
        text = (
            f"{path}: other numbers show a decimal comma; is the point in {doubt} a decimal point, or does it separate"
        )
        remedy = 'thousands? Say --decimal point or --decimal comma (in Python: decimal="." or decimal=",")'
        raise DecimalError(f"{text} {remedy}", ["--decimal point|comma"]) from None
    read_rows = np.any([np.isfinite(column) for column in columns], axis=0)
    if second := second_table(read_rows, lambda row: [*cells.slice(row, 1).to_pylist()[0].values()], titles):
        raise TraceError(f"{path}: {second}")
    if letters.doubtful:
        text = "the encoding of the names is not known; if they matter, state it (--encoding gbk, shift_jis, ...)"
        table.findings.append(Finding("encoding", text))
    return table


class DecimalError(Unstated):
    """A number can be read in two ways."""


class _Rows(io.RawIOBase):
    """The rows of numbers as bytes, for Arrow: without comments and the lines above."""

    def __init__(self, lines: Pieces, delimiter: str, skip: int) -> None:
        super().__init__()
        self._pieces = self._encoded(lines, delimiter, skip)
        self._left = memoryview(b"")

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: WriteableBuffer) -> int:
        into = memoryview(buffer)
        while not len(self._left):
            piece = next(self._pieces, None)
            if piece is None:
                return 0
            self._left = memoryview(piece)
        count = min(len(into), len(self._left))
        into[:count] = self._left[:count]
        self._left = self._left[count:]
        return count

    @staticmethod
    def _encoded(pieces: Pieces, delimiter: str, skip: int) -> Iterator[bytes]:
        for lines in pieces():
            rows = [_spaced(line, delimiter) + "\n" for line in lines if not is_comment(line)]
            yield "".join(rows[skip:]).encode()
            skip = max(0, skip - len(rows))


def _spaced(line: str, delimiter: str) -> str:
    """The line with single spaces, if these are the delimiter."""
    return " ".join(re.split("[ \t]+", line.strip())) if delimiter == " " else line


def _unit_beside(name: str, cells: pa.ChunkedArray) -> str:
    """The first cells alone show most columns that hold no unit."""
    likely = unit_beside(name, cells.slice(0, LOOKED_AT).to_pylist())
    return unit_beside(name, pc.unique(cells).to_pylist()) if likely else ""


def _numbers(cells: pa.ChunkedArray, mark: Decimal, asked: bool) -> Array:
    """A column of text as numbers. Arrow reads plain numbers, in a fraction of the memory; the rest goes one by one."""
    return np.concatenate([np.empty(0), *(_part(chunk, mark, asked) for chunk in cells.chunks)])


def _part(cells: pa.Array, mark: Decimal, asked: bool) -> Array:
    if mark == ".":
        try:
            return np.asarray(cells.cast(pa.float64()).to_numpy(zero_copy_only=False))
        except pa.ArrowInvalid:
            pass
    return numbers(cells.to_pylist(), mark, asked)


def _delimiter(lines: Sequence[str]) -> str:
    """The first of the delimiters that most lines contain; a space if none does."""
    for mark in _DELIMITERS:
        if 2 * sum(mark in line for line in lines) > len(lines):
            words = lines[len(lines) // 2].split()
            spaced = mark == "," and len(words) > 1 and all(has_decimal_comma(word) for word in words)
            return " " if spaced else mark
    return " "


def _cells(line: str, delimiter: str) -> list[str]:
    reader = csv.reader([line], delimiter=delimiter, skipinitialspace=True)
    try:
        return [cell.strip() for cell in next(reader, [])]
    except csv.Error:  # a cell of more than 131,072 characters
        return [line]


def _words(line: str, delimiter: str, width: int) -> list[str]:
    """The cells of a line above the numbers. A unit in brackets may stand behind a single space: `Depth (mm)`."""
    cells = _cells(_spaced(line, delimiter), delimiter)
    if len(cells) == width:
        return cells
    parts = re.split(r"\s{2,}|\t", line.strip())
    if len(parts) == width:
        return parts
    return cells if delimiter != " " else re.findall(r"\S+(?: [\[({<][^\])}>]*[\])}>])?", line)


def _parsed(path: Path, rows: _Rows, names: list[str], delimiter: str) -> tuple[pa.Table, list[int]]:
    """The cells of the columns as text, and in front of which a row of another width was left out."""
    broken: list[int] = []

    def left_out(row: pyarrow.csv.InvalidRow) -> str:
        broken.append(row.number - 1)
        return "skip" if len(broken) < _MOST_BROKEN else "error"

    try:
        table = pyarrow.csv.read_csv(
            io.BufferedReader(rows),
            pyarrow.csv.ReadOptions(column_names=names, use_threads=False, block_size=_BLOCK),  # so a row has a number
            pyarrow.csv.ParseOptions(delimiter=delimiter, invalid_row_handler=left_out),
            pyarrow.csv.ConvertOptions(column_types=dict.fromkeys(names, pa.string())),
        )
    except pa.ArrowInvalid as error:
        raise TraceError(f"{path}: is no table of numbers: {error}") from None
    return table, [row - i for i, row in enumerate(broken)]

"""Reads a table of numbers from a text file: what programs and testing machines write as CSV or TXT."""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.csv
from numpy.typing import NDArray

from punctura.trace.decimals import Decimal, DoubtfulNumber, decimal_in, has_decimal_comma, numbers
from punctura.trace.heading import column_names, first_row
from punctura.trace.size import LONGEST_NAME, MOST_COLUMNS, check_size
from punctura.trace.trace import TraceError

Array = NDArray[np.float64]

_DELIMITERS = (";", "\t", ",")  # a comma may be the decimal point of the others
_LOOKED_AT = (
    200  # lines at the end, which show delimiter and width; lines at the start, which may stand above the table
)
_LARGE, _PIECE = 100_000_000, 1 << 24  # bytes
_COMMENT = re.compile(r"^[#%].*\n", re.MULTILINE)
_EMPTY = re.compile(r"^[^\S\n]*\n", re.MULTILINE)
_SPACES = re.compile(r"[^\S\n]+")
_AT_ENDS = re.compile(r"^ | $", re.MULTILINE)


def read_text(path: Path, decimal: Decimal | None = None) -> dict[str, Array]:
    """All columns of a text file by name; a cell that holds no number is NaN. Raises TraceError, OSError.

    decimal: the mark in front of decimals; None: as the file shows, and a number that can be read in two ways is an
    error.

    Lines above the table are left out, but for the names of the columns and their units. Rows with another number of
    cells are NaN.
    """
    _check_large(path)
    text = _text_of(path, path.read_bytes())
    rows = _COMMENT.sub("", text) if _COMMENT.search(text) else text
    if not rows:
        raise TraceError(f"{path}: is empty")
    delimiter = _delimiter(_last_lines(rows))
    if delimiter == " ":
        text, rows = _single_spaced(text), _single_spaced(rows)
    looked_at = _first_lines(rows) + _last_lines(rows)
    check_size(path, 0, max(1 + line.count(delimiter) for line in looked_at))
    if max(map(len, looked_at)) > LONGEST_NAME * MOST_COLUMNS:
        raise TraceError(f"{path}: a line has more than {LONGEST_NAME * MOST_COLUMNS:,} characters; export it again")
    last = [_cells(line, delimiter) for line in _last_lines(rows)]
    width = Counter(len(row) for row in last).most_common(1)[0][0]
    check_size(path, rows.count("\n"), width)
    mark = decimal or decimal_in(cell for row in last for cell in row)
    lines = _first_lines(text)
    head = [[] if _is_comment(line) else _cells(line, delimiter) for line in lines]
    first = first_row(head, width, mark)
    if first == len(head):
        wanted = f"{width} cells in a row are expected, as at its end" if width > 1 else "it has no columns"
        raise TraceError(f"{path}: holds no rows of numbers; {wanted}")
    names = column_names([_cells(line.lstrip("#% "), delimiter) for line in lines[:first]], width)
    above = sum(len(line) + 1 for line in lines[:first] if not _is_comment(line))
    table, left_out = _parsed(path, rows[above:], names, delimiter)
    del text, rows
    try:
        read = {name: _numbers(table[name], mark, decimal is not None) for name in names}
    except DoubtfulNumber as doubt:
        raise TraceError(
            f"{path}: some numbers have a decimal comma; is the point in {doubt} a decimal point, or does it separate "
            'thousands? Say --decimal point or --decimal comma (in Python: decimal="." or decimal=",")'
        ) from None
    return {name: np.insert(cells, left_out, np.nan) for name, cells in read.items()}


def _text_of(path: Path, data: bytes) -> str:
    """The text of a file that holds `data`, without empty lines; each line ends in a newline. Raises TraceError.

    It is no list of lines: that takes many times as much memory.
    """
    text = _decoded(path, data)
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    if not text.endswith("\n"):
        text += "\n"
    return _EMPTY.sub("", text) if _EMPTY.search(text) else text


def _is_comment(line: str) -> bool:
    return line.startswith(("#", "%"))


def _single_spaced(text: str) -> str:
    return _AT_ENDS.sub("", _SPACES.sub(" ", text))


def _first_lines(text: str) -> list[str]:
    return text.split("\n", _LOOKED_AT)[:-1][:_LOOKED_AT]


def _last_lines(text: str) -> list[str]:
    return text[:-1].rsplit("\n", _LOOKED_AT)[-_LOOKED_AT:]


def _numbers(cells: pa.ChunkedArray, mark: Decimal, asked: bool) -> Array:
    """A column of text as numbers. Arrow reads plain numbers, in a fraction of the memory; the rest goes one by one."""
    if mark == ".":
        try:
            return np.asarray(cells.cast(pa.float64()).to_numpy())
        except pa.ArrowInvalid:
            pass
    return numbers(cells.to_pylist(), mark, asked)


def _check_large(path: Path) -> None:
    """Raises TraceError for a large file with too many numbers, before memory is taken for all of them."""
    if path.stat().st_size < _LARGE:
        return
    with path.open("rb") as file:
        first = file.read(_PIECE)
        count = first.count(b"\n") + sum(piece.count(b"\n") for piece in iter(lambda: file.read(_PIECE), b""))
    lines = _last_lines(_text_of(path, first))[:-1]  # the last one is cut
    delimiter = _delimiter(lines)
    widths = Counter(len(_cells(line, delimiter)) for line in lines)
    check_size(path, count, widths.most_common(1)[0][0] if widths else 1)


def _decoded(path: Path, data: bytes) -> str:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data.decode("utf-16", errors="replace")
    if b"\0" in data[:4096]:
        raise TraceError(f"{path}: is no text, Parquet, MAT or XLSX file; export the table as CSV")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")  # what programs on Windows write in western countries


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


def _parsed(path: Path, rows: str, names: list[str], delimiter: str) -> tuple[pa.Table, list[int]]:
    """The cells of the columns as text, and in front of which a row of another width was left out."""
    broken: list[int] = []

    def left_out(row: pyarrow.csv.InvalidRow) -> str:
        broken.append(row.number - 1)
        return "skip"

    try:
        table = pyarrow.csv.read_csv(
            pa.BufferReader(rows.encode()),
            pyarrow.csv.ReadOptions(column_names=names, use_threads=False),  # so the number of a row is known
            pyarrow.csv.ParseOptions(delimiter=delimiter, invalid_row_handler=left_out),
            pyarrow.csv.ConvertOptions(column_types=dict.fromkeys(names, pa.string())),
        )
    except pa.ArrowInvalid as error:
        raise TraceError(f"{path}: is no table of numbers: {error}") from None
    return table, [row - i for i, row in enumerate(broken)]

"""Reads a table of numbers from a text file: what programs and testing machines write as CSV or TXT."""

from __future__ import annotations

import csv
import io
import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.csv
from numpy.typing import NDArray

from punctura.trace.heading import column_names, first_row
from punctura.trace.size import LONGEST_NAME, MOST_COLUMNS, check_size
from punctura.trace.trace import TraceError

Array = NDArray[np.float64]

_DELIMITERS = (";", "\t", ",")  # a comma may be the decimal point of the others
_LOOKED_AT = (
    200  # lines at the end, which show delimiter and width; lines at the start, which may stand above the table
)
_DECIMAL_COMMA = re.compile(r"\s*[+-]?\d+,\d+([eE][+-]?\d+)?\s*")


def read_text(path: Path) -> dict[str, Array]:
    """All columns of a text file by name; a cell that holds no number is NaN. Raises TraceError, OSError.

    Lines above the table are left out, but for the names of the columns and their units. Rows with another number of
    cells are NaN.
    """
    lines = [line for line in _decoded(path).splitlines() if line.strip()]
    numbers = [line for line in lines if not line.startswith(("#", "%"))]
    if not numbers:
        raise TraceError(f"{path}: is empty")
    delimiter = _delimiter(numbers[-_LOOKED_AT:])
    if delimiter == " ":
        lines = [re.sub(r"\s+", " ", line.strip()) for line in lines]
    looked_at = numbers[:_LOOKED_AT] + numbers[-_LOOKED_AT:]
    check_size(path, 0, max(1 + line.count(delimiter) for line in looked_at))
    if max(map(len, looked_at)) > LONGEST_NAME * MOST_COLUMNS:
        raise TraceError(f"{path}: a line has more than {LONGEST_NAME * MOST_COLUMNS:,} characters; export it again")
    last = [_cells(line, delimiter) for line in lines[-_LOOKED_AT:] if not line.startswith(("#", "%"))]
    width = Counter(len(row) for row in last).most_common(1)[0][0]
    check_size(path, len(lines), width)
    decimal = "," if any(_DECIMAL_COMMA.fullmatch(cell) for row in last for cell in row) else "."
    head = [[] if line.startswith(("#", "%")) else _cells(line, delimiter) for line in lines[:_LOOKED_AT]]
    first = first_row(head, width, decimal)
    if first == len(head):
        raise TraceError(f"{path}: holds no rows of numbers; {width} cells in a row are expected, as at its end")
    names = column_names([_cells(line.lstrip("#% "), delimiter) for line in lines[:first]], width)
    return _parsed(path, [line for line in lines[first:] if not line.startswith(("#", "%"))], names, delimiter, decimal)


def _decoded(path: Path) -> str:
    data = path.read_bytes()
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
            spaced = mark == "," and len(words) > 1 and all(_DECIMAL_COMMA.fullmatch(word) for word in words)
            return " " if spaced else mark
    return " "


def _cells(line: str, delimiter: str) -> list[str]:
    reader = csv.reader([line], delimiter=delimiter, skipinitialspace=True)
    try:
        return [cell.strip() for cell in next(reader, [])]
    except csv.Error:  # a cell of more than 131,072 characters
        return [line]


def _parsed(path: Path, lines: list[str], names: list[str], delimiter: str, decimal: str) -> dict[str, Array]:
    broken: list[int] = []

    def left_out(row: pyarrow.csv.InvalidRow) -> str:
        broken.append(row.number - 1)
        return "skip"

    try:
        table = pyarrow.csv.read_csv(
            io.BytesIO("\n".join(lines).encode()),
            pyarrow.csv.ReadOptions(column_names=names, use_threads=False),  # so the number of a row is known
            pyarrow.csv.ParseOptions(delimiter=delimiter, invalid_row_handler=left_out),
            pyarrow.csv.ConvertOptions(column_types=dict.fromkeys(names, pa.string())),
        )
    except pa.ArrowInvalid as error:
        raise TraceError(f"{path}: is no table of numbers: {error}") from None
    places = [row - i for i, row in enumerate(broken)]
    return {name: np.insert(numbers(table.column(name).to_pylist(), decimal), places, np.nan) for name in names}


def numbers(cells: Sequence[Any], decimal: str = ".") -> Array:
    """Cells as numbers. A cell that is no number becomes NaN."""
    try:
        return np.array([np.nan if cell is None else cell for cell in cells], dtype=np.float64)
    except (ValueError, TypeError):
        return np.array([_number(cell, decimal) for cell in cells])


def _number(cell: Any, decimal: str) -> float:
    try:
        return float(cell.strip().replace(decimal, ".") if isinstance(cell, str) else cell)
    except (ValueError, TypeError):
        return np.nan

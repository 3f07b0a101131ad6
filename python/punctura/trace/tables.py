"""Reads a table of numbers from CSV, Parquet, MAT or XLSX."""

from __future__ import annotations

import io
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet
from numpy.typing import NDArray

from punctura.trace.trace import TraceError

Array = NDArray[np.float64]
Table = dict[str, Array]  # by the name of the column; a cell that holds no number is NaN

_DELIMITERS = (";", "\t", ",")  # a comma may be the decimal point of the others


def read_table(path: Path) -> Table:
    """All columns of a file. Raises TraceError, OSError."""
    readers = {".parquet": _parquet, ".mat": _mat, ".xlsx": _xlsx}
    table = readers.get(path.suffix.lower(), _text)(path)
    if not table or not len(next(iter(table.values()))):
        raise TraceError(f"{path}: holds no rows of numbers")
    return table


def _text(path: Path) -> Table:
    text = path.read_bytes().decode("utf-8-sig", errors="replace").replace("\r\n", "\n")
    lines = [line for line in text.split("\n") if line.strip() and not line.startswith(("#", "%"))]
    if not lines:
        raise TraceError(f"{path}: is empty")
    delimiter = next((mark for mark in _DELIMITERS if mark in lines[-1]), " ")
    if delimiter == " ":
        lines = [re.sub(r"\s+", " ", line.strip()) for line in lines]
    decimal = "," if delimiter != "," and "," in lines[-1] else "."
    cells = [cell.strip().strip('"') for cell in lines[0].split(delimiter)]
    headed = not any(_is_number(cell, decimal) for cell in cells)
    names = _unique(cells if headed else [str(i + 1) for i in range(len(cells))])
    try:
        table = pyarrow.csv.read_csv(
            io.BytesIO("\n".join(lines[headed:]).encode()),
            pyarrow.csv.ReadOptions(column_names=names),
            pyarrow.csv.ParseOptions(delimiter=delimiter),
            pyarrow.csv.ConvertOptions(decimal_point=decimal, column_types=dict.fromkeys(names, pa.string())),
        )
    except pa.ArrowInvalid as error:
        raise TraceError(f"{path}: is no table of numbers: {error}") from None
    return {name: _numbers(table.column(name).to_pylist(), decimal) for name in names}


def _is_number(cell: str, decimal: str) -> bool:
    try:
        float(cell.replace(decimal, "."))
    except ValueError:
        return False
    return True


def _numbers(cells: Sequence[Any], decimal: str = ".") -> Array:
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


def _unique(names: Iterable[str]) -> list[str]:
    """Names, each different: a repeated or empty name gets the number of its column."""
    seen: list[str] = []
    for i, name in enumerate(names):
        seen.append(name if name and name not in seen else f"{name or 'column'} {i + 1}")
    return seen


def _parquet(path: Path) -> Table:
    try:
        table = pyarrow.parquet.read_table(path)
    except pa.ArrowInvalid as error:
        raise TraceError(f"{path}: is no Parquet file: {error}") from None
    return {
        name: table.column(name).cast(pa.float64()).to_numpy()
        for name in table.column_names
        if pa.types.is_integer(kind := table.schema.field(name).type) or pa.types.is_floating(kind)
    }


def _mat(path: Path) -> Table:
    try:
        from scipy.io import loadmat
    except ImportError:
        raise TraceError(f"{path}: a MAT file needs scipy: pip install punctura[identify]") from None
    try:
        held = loadmat(path, squeeze_me=True, simplify_cells=True)
    except NotImplementedError:
        raise TraceError(f"{path}: is a MAT file of version 7.3; save it again with save(..., '-v7')") from None
    except Exception as error:  # scipy raises many types for a damaged file
        raise TraceError(f"{path}: is no MAT file: {error}") from None
    columns: Table = {}

    def collect(name: str, value: Any) -> None:
        if isinstance(value, dict):
            for key, inner in value.items():
                collect(key, inner)
        elif isinstance(value, np.ndarray) and value.ndim == 1 and value.dtype.kind in "biuf":
            columns[name] = value.astype(np.float64)

    for name, value in held.items():
        if not name.startswith("__"):
            collect(name, value)
    if not columns:
        raise TraceError(f"{path}: holds no vectors; save depth, force and time as one vector each")
    longest = max(len(column) for column in columns.values())
    return {name: column for name, column in columns.items() if len(column) == longest}


def _xlsx(path: Path) -> Table:
    try:
        from openpyxl import load_workbook
    except ImportError:
        raise TraceError(f"{path}: an XLSX file needs openpyxl: pip install punctura[identify]") from None
    try:
        sheet = load_workbook(path, read_only=True, data_only=True).worksheets[0]
    except Exception as error:  # openpyxl raises many types for a damaged file
        raise TraceError(f"{path}: is no XLSX file: {error}") from None
    rows = [row for row in sheet.iter_rows(values_only=True) if any(cell is not None for cell in row)]
    if not rows:
        raise TraceError(f"{path}: the first sheet is empty")
    headed = not any(isinstance(cell, (int, float)) for cell in rows[0])
    names = _unique(str(cell or "").strip() if headed else str(i + 1) for i, cell in enumerate(rows[0]))
    body = rows[headed:]
    return {name: _numbers([row[i] for row in body]) for i, name in enumerate(names)}

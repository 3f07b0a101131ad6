"""Reads a table of numbers from Parquet, MAT, XLSX, or text."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet
from numpy.typing import NDArray

from punctura.trace.heading import column_names, first_row
from punctura.trace.text import numbers, read_text
from punctura.trace.trace import TraceError

Array = NDArray[np.float64]
Table = dict[str, Array]  # by the name of the column; a cell that holds no number is NaN


def read_table(path: Path) -> Table:
    """All columns of a file. Raises TraceError, OSError."""
    readers = {".parquet": _parquet, ".mat": _mat, ".xlsx": _xlsx}
    table = readers.get(path.suffix.lower(), read_text)(path)
    if not table or not len(next(iter(table.values()))):
        raise TraceError(f"{path}: holds no rows of numbers")
    return table


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
    matrices: list[Array] = []

    def collect(name: str, value: Any) -> None:
        if isinstance(value, dict):
            for key, inner in value.items():
                collect(key, inner)
        elif isinstance(value, np.ndarray) and value.ndim == 1 and value.dtype.kind in "biuf":
            columns[name] = value.astype(np.float64)
        elif isinstance(value, np.ndarray) and value.ndim == 2 and value.dtype.kind in "biuf":
            matrices.append(value.astype(np.float64))

    for name, value in held.items():
        if not name.startswith("__"):
            collect(name, value)
    if not columns and len(matrices) == 1:
        return {str(i + 1): column for i, column in enumerate(matrices[0].T)}
    if not columns:
        raise TraceError(f"{path}: holds neither vectors nor one matrix; save depth, force and time as one vector each")
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
    width = max(len(row) for row in rows)
    rows = [(*row, *(None for _ in range(width - len(row)))) for row in rows]
    first = first_row(rows, width)
    names = column_names(rows[:first], width)
    return {name: numbers([row[i] for row in rows[first:]]) for i, name in enumerate(names)}

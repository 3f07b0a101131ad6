"""Reads a table of numbers from Parquet, MAT, XLSX, or text."""

from __future__ import annotations

from collections.abc import Iterator
from math import prod
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet
from numpy.typing import NDArray

from punctura.trace.decimals import Decimal, numbers
from punctura.trace.heading import column_names, first_row
from punctura.trace.packed import check_mat, check_workbook
from punctura.trace.size import check_bytes, check_names, check_size
from punctura.trace.text import read_text
from punctura.trace.trace import MissingPackage, TraceError
from punctura.trace.unreadable import unreadable

Array = NDArray[np.float64]
Table = dict[str, Array]  # by the name of the column; a cell that holds no number is NaN


def read_table(path: Path, decimal: Decimal | None = None) -> Table:
    """All columns of a file. decimal: the mark in front of decimals in a text file. Raises TraceError, OSError."""
    check_bytes(path)
    readers = {".parquet": _parquet, ".mat": _mat, ".xlsx": _xlsx}
    reader = readers.get(path.suffix.lower())
    table = read_text(path, decimal) if reader is None else reader(path)
    if not table or not len(next(iter(table.values()))):
        raise TraceError(f"{path}: holds no rows of numbers")
    check_names(path, table)
    return table


def _parquet(path: Path) -> Table:
    try:
        with pyarrow.parquet.ParquetFile(path) as file:
            schema, rows = file.schema_arrow, file.metadata.num_rows
            names = [field.name for field in schema if _is_number(field.type)]
            check_size(path, 0, len(schema))
            check_size(path, rows, len(names))
            check_names(path, schema.names)
            if len(set(schema.names)) < len(schema):
                raise TraceError(f"{path}: two columns have the same name; rename one")
            return {name: file.read([name], use_threads=False)[name].cast(pa.float64()).to_numpy() for name in names}
    except (pa.ArrowException, OSError) as error:
        raise unreadable(path, "Parquet", error) from None


def _is_number(kind: pa.DataType) -> bool:
    return bool(pa.types.is_integer(kind) or pa.types.is_floating(kind))


def _mat(path: Path) -> Table:
    try:
        from scipy.io import loadmat, whosmat
    except ImportError:
        raise MissingPackage(f"{path}: a MAT file needs scipy: pip install punctura[identify]") from None
    try:
        check_mat(path, structures=False)
        variables = whosmat(path)
        wanted = [name for name, shape, kind in variables if kind != "cell" and (kind != "struct" or prod(shape) == 1)]
        check_mat(path, structures=any(kind == "struct" for name, _, kind in variables if name in wanted))
        check_size(path, 0, len(variables))
        check_size(
            path, sum(prod(shape) for _, shape, kind in variables if kind not in ("cell", "struct", "sparse")), 1
        )
        held = loadmat(path, squeeze_me=True, simplify_cells=True, variable_names=wanted)
    except TraceError:
        raise
    except NotImplementedError:
        raise TraceError(f"{path}: is a MAT file of version 7.3; save it again with save(..., '-v7')") from None
    except Exception as error:  # scipy raises many types for a damaged file
        raise unreadable(path, "MAT", error) from None
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
        check_size(path, *matrices[0].shape)
        return {str(i + 1): column for i, column in enumerate(matrices[0].T)}
    if not columns:
        raise TraceError(f"{path}: holds neither vectors nor one matrix; save depth, force and time as one vector each")
    longest = max(len(column) for column in columns.values())
    check_size(path, longest, len(columns))
    return {name: column for name, column in columns.items() if len(column) == longest}


def _xlsx(path: Path) -> Table:
    try:
        from openpyxl import load_workbook
    except ImportError:
        raise MissingPackage(f"{path}: an XLSX file needs openpyxl: pip install punctura[identify]") from None
    try:
        check_workbook(path)
        book = load_workbook(path, read_only=True, data_only=True)
        rows = list(_filled_rows(path, book.worksheets[0]))
    except TraceError:
        raise
    except Exception as error:  # openpyxl raises many types for a damaged file
        raise unreadable(path, "XLSX", error) from None
    if not rows:
        raise TraceError(f"{path}: the first sheet is empty")
    width = max(len(row) for row in rows)
    check_size(path, len(rows), width)
    rows = [(*row, *(None for _ in range(width - len(row)))) for row in rows]
    first = first_row(rows, width)
    names = column_names(rows[:first], width)
    return {name: numbers([row[i] for row in rows[first:]]) for i, name in enumerate(names)}


def _filled_rows(path: Path, sheet: Any) -> Iterator[tuple[Any, ...]]:
    """The rows of a sheet that hold something."""
    sheet.reset_dimensions()  # a file may state a sheet of a million rows and 16,384 columns
    numbers = 0
    for row in sheet.iter_rows(values_only=True):
        width = max((i for i, cell in enumerate(row, 1) if cell is not None), default=0)
        numbers += width
        check_size(path, 0, width)
        check_size(path, numbers, 1)
        if width:
            yield row[:width]

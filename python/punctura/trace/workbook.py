"""Reads the sheets of a workbook: XLSX by openpyxl, XLS by xlrd."""

import io
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import IO, Any

import numpy as np

from punctura.extras import MissingPackageError, optional
from punctura.trace.cells import column, unit_beside
from punctura.trace.decimals import Decimal, decimal_in
from punctura.trace.heading import column_names, first_row, second_table, with_unit
from punctura.trace.lines import LOOKED_AT
from punctura.trace.packed import check_workbook
from punctura.trace.reading import Reading, only_trace, wanted_sheet
from punctura.trace.table import Table, check_size, unreadable
from punctura.trace.trace import TraceError

MEANS = {"mean", "average", "mittelwert", "durchschnitt", "moyenne", "media", "promedio", "平均", "平均值"}


def read_workbook(path: Path, reading: Reading, old: bool) -> Table:
    """The sheet that is stated, or the only one that can be a trace. Raises TraceError, OSError.

    old: an XLS file, as Excel wrote it before 2007.
    """
    try:
        with path.open("rb") as file:
            names, rows_of = _old_sheets(path) if old else _sheets(path, file)
            wanted = _specimens(names) if reading.sheet is None else [wanted_sheet(path, names, reading.sheet)]
            tables = {name: _table(path, list(_filled_rows(path, rows_of(name))), reading.decimal) for name in wanted}
    except (TraceError, MissingPackageError):
        raise
    except Exception as error:  # readers raise many types for a damaged file
        raise unreadable(path, "XLS" if old else "XLSX", error) from None
    table = only_trace(path, {name: table for name, table in tables.items() if table}, reading)
    if table.unclear:
        raise TraceError(f"{path}: {table.unclear}")
    return table


def _specimens(names: list[str]) -> list[str]:
    """The sheets (n,) without those that are named as the mean of others, unless there are no others."""
    return [name for name in names if not set(name.casefold().split()) & MEANS] or names


Rows = Iterable[Sequence[Any]]


def _sheets(path: Path, file: IO[bytes]) -> tuple[list[str], Callable[[str], Rows]]:
    """The names of the sheets of an XLSX file, and what reads the rows of one."""
    load_workbook = optional("openpyxl", "identify", f"{path}: an XLSX file").load_workbook
    check_workbook(path)
    book = load_workbook(file, read_only=True, data_only=True)  # not the path: it may end in .xls

    def rows_of(name: str) -> Rows:
        sheet = book[name]
        sheet.reset_dimensions()  # a file may state a sheet of a million rows and 16,384 columns
        rows: Rows = sheet.iter_rows(values_only=True)
        return rows

    return [sheet.title for sheet in book.worksheets], rows_of


def _old_sheets(path: Path) -> tuple[list[str], Callable[[str], Rows]]:
    """As _sheets(), for an XLS file. Its sheets have at most 65,536 rows and 256 columns."""
    reader = optional("xlrd", "formats", f"{path}: an XLS file")
    book = reader.open_workbook(path, on_demand=True, logfile=io.StringIO(), ragged_rows=True)

    def rows_of(name: str) -> Rows:
        for row in book.sheet_by_name(name).get_rows():
            yield [
                reader.xldate_as_datetime(cell.value, book.datemode) if cell.ctype == reader.XL_CELL_DATE
                else cell.value if cell.ctype in (reader.XL_CELL_NUMBER, reader.XL_CELL_TEXT) else None
                for cell in row
            ]  # fmt: skip

    return book.sheet_names(), rows_of


def _table(path: Path, rows: Sequence[tuple[Any, ...]], decimal: Decimal | None) -> Table:
    """The columns of a sheet; empty if it has no rows of numbers."""
    width = max(map(len, rows), default=0)
    check_size(path, len(rows), width)
    rows = [(*row, *(None for _ in range(width - len(row)))) for row in rows]
    mark = decimal or decimal_in(zip(*rows[-LOOKED_AT:], strict=True))
    first = first_row(rows, width, mark)
    names = column_names(rows[:first], width) if first < len(rows) else []
    headed = [i for i, cell in enumerate(rows[first - 1]) if isinstance(cell, str)] if 0 < first < len(rows) else []
    while headed and all(rows[-1][i] in (None, "") for i in headed):  # what was computed beside the table is longer
        rows.pop()
    cells = [[row[i] for row in rows[first:]] for i in range(width)]
    table = Table()
    for i, name in enumerate(names):
        named, values = column(name, cells[i], mark, decimal is not None)
        beside = unit_beside(names[i + 1], set(cells[i + 1])) if i + 1 < width else ""
        table[with_unit(named, beside)] = values
    if table:
        read = np.any([np.isfinite(values) for values in table.values()], axis=0)
        table.unclear = second_table(read, lambda row: rows[first + row], rows[:first])
    return table


def _filled_rows(path: Path, rows: Rows) -> Iterator[tuple[Any, ...]]:
    """The rows of a sheet that hold something."""
    numbers = 0
    for row in rows:
        width = max((i for i, cell in enumerate(row, 1) if cell not in (None, "")), default=0)
        numbers += width
        check_size(path, 0, width)
        check_size(path, numbers, 1)
        if width:
            yield tuple(row[:width])

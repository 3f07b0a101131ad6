"""Reads the sheets of a workbook (XLSX)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from punctura.extras import optional
from punctura.trace.clock import clock_column, clock_seconds, is_clock
from punctura.trace.decimals import Decimal, decimal_in, numbers
from punctura.trace.heading import column_names, first_row
from punctura.trace.lines import LOOKED_AT
from punctura.trace.packed import check_workbook
from punctura.trace.reading import Reading
from punctura.trace.sheets import only_trace, wanted_sheet
from punctura.trace.size import check_size
from punctura.trace.table import Table
from punctura.trace.trace import TraceError
from punctura.trace.unreadable import unreadable


def read_workbook(path: Path, reading: Reading) -> Table:
    """The sheet that is stated, or the only one that can be a trace. Raises TraceError, OSError."""
    load_workbook = optional("openpyxl", "identify", f"{path}: an XLSX file").load_workbook
    try:
        check_workbook(path)
        book = load_workbook(path, read_only=True, data_only=True)
        names = [sheet.title for sheet in book.worksheets]
        wanted = names if reading.sheet is None else [wanted_sheet(path, names, reading.sheet)]
        tables = {name: _table(path, list(_filled_rows(path, book[name])), reading.decimal) for name in wanted}
    except TraceError:
        raise
    except Exception as error:  # openpyxl raises many types for a damaged file
        raise unreadable(path, "XLSX", error) from None
    return only_trace(path, {name: table for name, table in tables.items() if table}, reading)


def _table(path: Path, rows: Sequence[tuple[Any, ...]], decimal: Decimal | None) -> Table:
    """The columns of a sheet; empty if it has no rows of numbers."""
    width = max(map(len, rows), default=0)
    check_size(path, len(rows), width)
    rows = [(*row, *(None for _ in range(width - len(row)))) for row in rows]
    mark = decimal or decimal_in(cell for row in rows[-LOOKED_AT:] for cell in row if isinstance(cell, str))
    first = first_row(rows, width, mark)
    table = Table()
    for i, name in enumerate(column_names(rows[:first], width) if first < len(rows) else ()):
        cells = [row[i] for row in rows[first:]]
        clock = is_clock(cells)
        table[clock_column(name) if clock else name] = (
            clock_seconds(cells) if clock else numbers(cells, mark, decimal is not None)
        )
    return table


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

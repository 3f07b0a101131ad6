"""What the user states about a trace file, where the file does not state it, and which of its tables is the trace.

The tables are the sheets of a workbook or the groups of a TDMS file.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from punctura.trace.columns import REQUIRED, candidates, place_of
from punctura.trace.decimals import Decimal
from punctura.trace.table import Table
from punctura.trace.trace import TraceError, Unstated

Order = Literal["recorded", "depth"]


@dataclass(frozen=True)
class Reading:
    """How to read a trace file. Each field is as in read_trace()."""

    columns: Mapping[str, str | int] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    order: Order = "recorded"
    decimal: Decimal | None = None
    encoding: str | None = None
    sheet: str | None = None
    speeds: tuple[tuple[float, float], ...] = ()
    depth_file: str | None = None

    @property
    def needed(self) -> tuple[str, ...]:
        """The columns that a table must have."""
        return ("force", "time") if self.speeds or self.depth_file else REQUIRED


class SheetError(Unstated):
    """A file holds several traces. sheets: their names."""

    def __init__(self, text: str, sheets: Sequence[str]) -> None:
        super().__init__(text, ["--sheet NAME"])
        self.sheets = tuple(sheets)


def wanted_sheet(path: Path, names: Sequence[str], sheet: str) -> str:
    """The name of a sheet that is stated by name or by number from 1. Raises TraceError."""
    if sheet in names:
        return sheet
    if sheet.isdigit() and 1 <= int(sheet) <= len(names):
        return names[int(sheet) - 1]
    raise SheetError(f"{path}: there is no sheet {sheet!r}; the sheets are {_listed(names)} (--sheet NAME)", names)


def only_trace(path: Path, tables: Mapping[str, Table], reading: Reading) -> Table:
    """The one table that can be a trace; else the one table that there is. Raises SheetError if it is not clear."""
    traces = [name for name, table in tables.items() if is_trace(table, reading)] or list(tables)
    timed = [name for name in traces if candidates("time", list(tables[name]))]
    traces = timed or traces  # a table of results has a force and a way of each specimen, and no time
    if len(traces) == 1:
        return tables[traces[0]]
    if not traces:
        raise TraceError(f"{path}: holds no rows of numbers")
    text = f"{path}: {len(traces)} tables can be the trace: {_listed(traces)}; choose one (--sheet NAME)"
    raise SheetError(f"{text}, or identify all of them (punctura identify FILE --out FOLDER)", traces)


def is_trace(table: Table, reading: Reading) -> bool:
    """Whether a table has the columns that are stated, or known by their names, and at least five rows."""
    names, stated = list(table), reading.columns
    long_enough = len(next(iter(table.values()), ())) >= 5
    return long_enough and all(
        place_of(stated[role], names) is not None if role in stated else candidates(role, names)
        for role in reading.needed
    )


def _listed(names: Sequence[str]) -> str:
    shown = ", ".join(repr(name) for name in names[:20])
    return shown + (f" and {len(names) - 20} more" if len(names) > 20 else "")

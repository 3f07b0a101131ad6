"""Where the numbers of a table begin, and the names of its columns above them, as testing machines write them."""

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from punctura.trace.clock import is_clock
from punctura.trace.decimals import Decimal, number
from punctura.trace.names import role_named
from punctura.trace.units import is_unit, split_cell, split_name, unit_of

Row = Sequence[Any]  # cells: numbers, text, or empty (None or "")

_NEAR = 8  # rows above the numbers, in which their names and units may stand
_MOST_TEXTS = 1000  # rows without numbers that are looked at
_FEWEST = 5  # rows of numbers: fewer are a table of results at the end
_MOST_ABOVE = 200  # rows, in which a table of results may stand above that of the samples


def is_number(cell: Any, decimal: Decimal = ".") -> bool:
    """Whether a cell holds a number, as text with this decimal mark or as such."""
    if not isinstance(cell, str):
        return (isinstance(cell, (int, float)) and not isinstance(cell, bool)) or is_clock([cell])
    try:
        float(cell.strip().replace(decimal, "."))
    except ValueError:
        return not math.isnan(number(cell, decimal, True)) or is_clock([cell])
    return True


def first_row(rows: Sequence[Row], width: int, decimal: Decimal = ".") -> int:
    """The index of the first row of numbers: it and the next row have `width` cells and at least two numbers.

    len(rows) if there is none. A report above the table may contain single numbers, and a table of results that is
    shorter. Numbers with units (`0.35 N`) count if there is no row of plain ones: they can be names of columns.
    """
    least = min(2, width)
    full = [len(row) == width and sum(is_number(cell, decimal) for cell in row) >= least for row in rows]
    for i, good in enumerate(full):
        if good and next((full[j] for j in range(i + 1, len(rows)) if rows[j]), True):  # a comment has no cells
            while i > 0 and _has_gaps(rows[i - 1], width, decimal):
                i -= 1
            table = (
                j for j in range(i, min(i + 4, len(rows)))
                if not _is_heading(rows[j]) and not (_is_label(rows[j], decimal) and not _is_label(rows[-1], decimal))
            )  # fmt: skip
            first = next(table, i)  # i, if each row has texts such as units
            for j in range(first + 1, min(len(rows), _MOST_ABOVE)):  # the same names again begin a block of this table
                if _names_columns(rows[j]) and rows[j] not in rows[:j] and sum(full[j:]) > sum(full[first:j]):
                    return j + first_row(rows[j:], width, decimal)
            return first
    bare = [[split_cell(cell)[0] if isinstance(cell, str) else cell for cell in row] for row in rows]
    return len(rows) if bare == [list(row) for row in rows] else first_row(bare, width, decimal)


def second_table(read: NDArray[np.bool_], row_at: Callable[[int], Row], above: Sequence[Row]) -> str:
    """What is wrong where other names or units stand within the numbers, and numbers follow them; else empty.

    read (n,): the rows that hold a number. row_at: the cells of a row.
    """
    for at in np.flatnonzero(~read)[:_MOST_TEXTS].tolist():
        cells = row_at(at)
        if _other_heading(cells, above) and read[at:].sum() >= _FEWEST:
            named = ", ".join("" if cell is None else str(cell) for cell in cells)
            return (
                f"behind {int(read[:at].sum())} rows of numbers begins another table ({named:.80}), and its columns or "
                "units are not those of the first one. Save each table as a file of its own"
            )
    return ""


def _other_heading(row: Row, above: Iterable[Row]) -> bool:
    """Whether a row within the numbers names columns or units, and not as a row above them does."""
    plain = [[str(cell or "").strip().casefold() for cell in one] for one in (row, *above)]
    return _is_heading(row) and plain[0] not in plain[1:]


def _is_heading(row: Row) -> bool:
    """Whether texts name two of the columns, or two units. Numbers may stand beside them, such as those of formulas."""
    return (
        _names_columns(row) or sum(is_unit(cell) for cell in row if isinstance(cell, str) and not is_number(cell)) > 1
    )


def _names_columns(row: Row) -> bool:
    texts = [cell for cell in row if isinstance(cell, str) and not is_number(cell)]
    return len({role_named(split_name(text)[0]) for text in texts} - {""}) > 1


def _is_label(row: Row, decimal: Decimal = ".") -> bool:
    """Whether a row has a word in front of numbers: `Channel,0,1,2`."""
    first, others = (row[0], [cell for cell in row[1:] if not _empty(cell)]) if len(row) else ("", [])
    word = isinstance(first, str) and first[:1].isalpha() and not is_number(first, decimal)
    return word and len(others) > 0 and all(is_number(cell, decimal) for cell in others)


def _has_gaps(row: Row, width: int, decimal: Decimal) -> bool:
    """Whether a row of the table lacks numbers: some cells are empty, and no cell is text."""
    cells = [cell for cell in row if not _empty(cell)]
    return len(row) == width and bool(cells) and all(is_number(cell, decimal) for cell in cells)


def column_names(above: Sequence[Row], width: int, least: int | None = None) -> list[str]:
    """Names for `width` columns from the rows above the numbers: the last row, with the units of a row beside it.

    least: so many must be there, where the last columns are empty. Without names, the columns have their numbers, from
    1.
    """
    rows = list(above)
    while rows and (_is_label(rows[-1]) or not any(str(cell or "").strip(" -") for cell in rows[-1])):
        rows.pop()
    near = [cells for row in rows[-_NEAR:] if (cells := _texts(row, width, least or width))]
    named = [cells for cells in near if _names_columns(cells)]
    fitting = [_texts(row, width, least or width) for row in rows[-2:]]
    if named and named[-1] not in fitting:  # channels, ranges and sensors stand between the names and the units
        fitting = [named[-1], *[cells for cells in near if _are_units(cells)][-1:]]
    names = next(iter(fitting[-1:]), None)
    if names is not None and len(fitting) == 2 and (other := fitting[0]) is not None:
        if _are_units(names) or _are_units(other):
            names, units = (other, names) if _are_units(names) else (names, other)
            names = [with_unit(name, unit) for name, unit in zip(names, units, strict=True)]
    elif names is not None and all(map(unit_of, names)):  # units alone
        names = [f"[{unit_of(name)}]" for name in names]
    return unique(names if names is not None else [str(i + 1) for i in range(width)])


def unique(names: Iterable[str]) -> list[str]:
    """Names, each different: a repeated or empty name gets the number of its column."""
    seen: list[str] = []
    for i, name in enumerate(names):
        seen.append(name if name and name not in seen else f"{name or 'column'} {i + 1}")
    return seen


def _texts(row: Row, width: int, least: int) -> list[str] | None:
    """The cells as texts if they can be names: as many as columns, some text, no number unless it is a heading."""
    heading = _is_heading(row)
    cells = ["" if cell is None or (heading and is_number(cell)) else str(cell).strip() for cell in row]
    cells += [""] * (width - len(cells) if len(cells) >= least else 0)
    while len(cells) > width and not cells[-1]:
        cells.pop()
    named = len(cells) == width and any(cells) and (heading or not any(is_number(cell) for cell in row))
    return cells if named else None


def _are_units(cells: Sequence[str]) -> bool:
    written = [cell for cell in cells if cell]
    return sum(map(is_unit, written)) >= min(2, len(written))


def with_unit(name: str, unit: str) -> str:
    """A column's name with a unit that is stated elsewhere in the file, unless the name has one."""
    unit = unit_of(unit) or unit.strip().strip("()[]")
    return f"{name} [{unit}]" if unit and not is_unit(split_name(name)[1]) else name


def _empty(cell: Any) -> bool:
    return cell is None or (isinstance(cell, str) and not cell.strip())

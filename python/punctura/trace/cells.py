"""The cells of a column: numbers, numbers with units (`0.35 N`, or the unit in the next column), times of a clock."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from punctura.trace.clock import clock_column, clock_seconds, is_clock
from punctura.trace.decimals import Decimal, numbers
from punctura.trace.heading import with_unit
from punctura.trace.units import UNITS, role_of, split_cell, split_name, unit_of

Array = NDArray[np.float64]

_LOOKED_AT = 200
_UNITS = re.compile(
    r"(.*[\s_.])?(units?|einheit|unités?|unidad|unità|unidade|单位|單位|単位|단위)[\s_.]*\d*|(column )?\d*",
    re.IGNORECASE,
)


def are_plain(cells: Sequence[Any]) -> bool:
    """Whether the first cells are neither times of a clock nor numbers with units."""
    looked = cells[:_LOOKED_AT]
    return not is_clock(looked) and not _role(looked)


def column(name: str, cells: Sequence[Any], mark: Decimal = ".", asked: bool = False) -> tuple[str, Array]:
    """A column's name with the unit of its cells, and these as numbers; NaN for a cell that holds none.

    A cell in another unit of the same quantity is converted, as instruments change their range. Raises DoubtfulNumber.
    """
    looked = cells[:_LOOKED_AT]
    if is_clock(looked):
        return clock_column(name), clock_seconds(cells)
    role = _role(looked)
    if not role:
        return name, numbers(cells, mark, asked)
    split = [split_cell(cell) if isinstance(cell, str) else ("", "") for cell in cells]
    sizes = UNITS[role]
    wanted = split_name(name)[1]
    unit = wanted if wanted in sizes else next(unit for _, unit in split if unit)
    values = numbers([text if unit in sizes else None for text, unit in split], mark, asked)
    return with_unit(name, unit), values * np.array([sizes.get(each, np.nan) / sizes[unit] for _, each in split])


def unit_beside(name: str, cells: Collection[Any]) -> str:
    """The unit that a column holds for the numbers at its left; empty if it is no such column. cells: the distinct
    ones. Its name must be `Unit`, `Load Unit` or none: a column `sex` may hold the letter m."""
    texts = {str(cell).strip() for cell in cells} - {"", "None"}
    return unit_of(next(iter(texts))) if len(texts) == 1 and _UNITS.fullmatch(name) else ""


def _role(cells: Sequence[Any]) -> str:
    """The quantity of cells that all have a unit of it; else empty."""
    filled = [cell for cell in cells if cell is not None and (not isinstance(cell, str) or cell.strip())]
    units = {split_cell(cell)[1] if isinstance(cell, str) else "" for cell in filled}
    roles = {role_of(unit) for unit in units}
    return roles.pop() if len(roles) == 1 else ""

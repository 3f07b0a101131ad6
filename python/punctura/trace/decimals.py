"""Numbers in the cells of a text file: with a decimal point or a decimal comma, and marks between thousands."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Decimal = Literal[".", ","]

_WITH_COMMA = re.compile(r"\s*[+-]?(\d+|\d{1,3}(\.\d{3})+),\d+([eE][+-]?\d+)?\s*")
_POINTS = re.compile(r"\s*[+-]?\d+(\.\d+)+([eE][+-]?\d+)?\s*")  # points and no comma
_GROUPED = {
    ".": re.compile(r"\s*[+-]?\d{1,3}(,\d{3})+(\.\d*)?\s*"),
    ",": re.compile(r"\s*[+-]?\d{1,3}(\.\d{3})+(,\d*)?\s*"),
}


class DoubtfulNumber(ValueError):
    """A number that can be read in two ways."""


def has_decimal_comma(cell: str) -> bool:
    """Whether a cell is a number with a decimal comma: 1,5 or 1.234,5."""
    return bool(_WITH_COMMA.fullmatch(cell))


def decimal_in(cells: Iterable[str]) -> Decimal:
    """The decimal mark of these cells: a comma if one of them has it."""
    return "," if any(has_decimal_comma(cell) for cell in cells) else "."


def number(cell: Any, decimal: Decimal = ".", asked: bool = False) -> float:
    """The cell as a number; NaN if it is none. asked: the user said what the decimal mark is.

    Marks between thousands are left out. Raises DoubtfulNumber for 1.234 among decimal commas, unless asked.
    """
    if not isinstance(cell, str):
        return float(cell) if isinstance(cell, (int, float)) else np.nan
    if decimal == "," and not asked and _POINTS.fullmatch(cell):
        raise DoubtfulNumber(cell.strip())
    if _GROUPED[decimal].fullmatch(cell):
        cell = cell.replace("," if decimal == "." else ".", "")
    elif decimal == "," and "." in cell:
        return np.nan
    try:
        return float(cell.strip().replace(decimal, "."))
    except ValueError:
        return np.nan


def numbers(cells: Sequence[Any], decimal: Decimal = ".", asked: bool = False) -> NDArray[np.float64]:
    """Cells as numbers, NaN for a cell that is none. Raises DoubtfulNumber, as number() does."""
    if decimal == "." or not any(isinstance(cell, str) and "." in cell for cell in cells):
        try:
            return np.array([np.nan if cell is None else cell for cell in cells], dtype=np.float64)
        except (ValueError, TypeError):
            pass
    return np.array([number(cell, decimal, asked) for cell in cells], dtype=np.float64)

"""Numbers in the cells of a text file: with a decimal point or a decimal comma, and marks between thousands."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from punctura.trace.units import split_cell

Decimal = Literal[".", ","]

_BETWEEN = r"[\s'\u2019]"  # marks between thousands, beside a point or a comma: any space, also a narrow one
_WITH_COMMA = re.compile(rf"\s*[+-]?(\d*|\d{{1,3}}((\.|{_BETWEEN})\d{{3}})+),\d+([eE][+-]?\d+)?\s*")
_POINTS = re.compile(r"\s*[+-]?\d+(\.\d+)+([eE][+-]?\d+)?\s*")  # points and no comma
_NUMBER = re.compile(rf"\s*[+-]?[.,]?\d(\d|[.,]|{_BETWEEN})*([eE][+-]?\d+)?\s*")
_THOUSANDS = r"\s*[+-]?[1-9]\d{0,2}(%s\d{3})+"
_GROUPED = {
    ".": re.compile(_THOUSANDS % f"(,|{_BETWEEN})" + r"(\.\d*)?\s*"),
    ",": re.compile(_THOUSANDS % f"(\\.|{_BETWEEN})" + r"(,\d*)?\s*"),
}
_OTHER: dict[str, Decimal] = {".": ",", ",": "."}
_MARKS = {mark: re.compile(rf"[{other}]|{_BETWEEN}") for mark, other in _OTHER.items()}


class DoubtfulNumber(ValueError):
    """A number that can be read in two ways."""


def has_decimal_comma(cell: str) -> bool:
    """Whether a cell is a number with a decimal comma: 1,5 or 1.234,5."""
    return bool(_WITH_COMMA.fullmatch(cell))


def decimal_in(columns: Iterable[Iterable[Any]]) -> Decimal:
    """The decimal mark of these columns of cells: a comma if one has it, and none that must have a point.

    `1,050` can be a thousand and fifty; beside `0.25` and without `0,25` it is, and also below `980` in one column.
    """
    seen: set[tuple[str, bool]] = set()
    for cells in columns:
        texts = {split_cell(cell)[0].strip() for cell in cells if isinstance(cell, str)}
        texts = {text for text in texts if _NUMBER.fullmatch(text)}
        shown = {_shown(text) for text in texts if re.search("[.,]", text)}
        if (
            len(shown) == 1
            and not next(iter(shown))[1]
            and any(re.fullmatch(r"[+-]?[1-9]\d\d", text) for text in texts)
        ):
            shown = {(_OTHER[mark], True) for mark, _ in shown}
        seen |= shown
    return "," if (",", True) in seen or ((",", False) in seen and (".", True) not in seen) else "."


def _shown(cell: str) -> tuple[str, bool]:
    """The decimal mark that a number with marks has, and whether that is sure."""
    marks = re.findall("[.,]", cell)
    if marks.count(marks[-1]) > 1:  # between thousands
        return _OTHER[marks[-1]], True
    return marks[-1], len(marks) > 1 or not re.fullmatch(r"[+-]?[1-9]\d{0,2}[.,]\d{3}", cell)


def number(cell: Any, decimal: Decimal = ".", asked: bool = False) -> float:
    """The cell as a number; NaN if it is none. asked: the user stated the decimal mark.

    Marks between thousands are left out. Raises DoubtfulNumber for 1.234 among decimal commas, unless asked.
    """
    if not isinstance(cell, str):
        try:
            return float(cell) if isinstance(cell, (int, float)) else np.nan
        except OverflowError:  # a whole number of more than 308 digits
            return np.nan
    cell = cell.replace("\u2212", "-")
    if decimal == "," and not asked and _POINTS.fullmatch(cell):
        raise DoubtfulNumber(cell.strip())
    if _GROUPED[decimal].fullmatch(cell):
        cell = _MARKS[decimal].sub("", cell)
    elif decimal == "," and "." in cell:
        return np.nan
    try:
        return float(cell.strip().replace(decimal, "."))
    except ValueError:
        return np.nan


def numbers(cells: Sequence[Any], decimal: Decimal = ".", asked: bool = False) -> NDArray[np.float64]:
    """Cells as numbers, NaN for a cell that is none. Raises DoubtfulNumber, as number() does.

    A column among decimal commas may have decimal points: `0.25` beside no comma shows them.
    """
    if decimal == "," and not asked and decimal_in([cells]) == ".":
        shown = (cell for cell in cells if isinstance(cell, str) and _POINTS.fullmatch(cell) and _shown(cell)[1])
        decimal = "." if next(shown, None) else ","
    if decimal == "." or not any(isinstance(cell, str) and "." in cell for cell in cells):
        try:
            return np.array([np.nan if cell is None else cell for cell in cells], dtype=np.float64)
        except (ValueError, TypeError, OverflowError):
            pass
    return np.array([number(cell, decimal, asked) for cell in cells], dtype=np.float64)

"""The columns of a motion file, and its numbers line by line: slow, but it finds the wrong line and the reason."""

from __future__ import annotations

import csv
import difflib
import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from punctura._core import PuncturaError

TABLES = (".parquet", ".npy", ".npz")  # files without lines of text


class MotionError(PuncturaError, ValueError):
    """An invalid motion file. Names the file, the line or row (0 for the whole file), the problem and the remedy."""

    def __init__(self, file: str | Path, line: int, what: str) -> None:
        self.file = str(file)
        self.line = line
        self.what = what
        place = "line" if Path(file).suffix.lower() not in TABLES else "row"
        super().__init__(f"{file}, {place} {line}: {what}" if line else f"{file}: {what}")

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.file, self.line, self.what)


TIME_AND_POSITION = ["time_s", "x_m", "y_m", "z_m"]
AXIS = ["axis_x", "axis_y", "axis_z"]

_WANTED = f"the columns must be {','.join(TIME_AND_POSITION)} or {','.join(TIME_AND_POSITION + AXIS)}"


def read_header(line: bytes, file: Path) -> list[str]:
    """The column names in a motion file's first line. Raises MotionError for wrong names."""
    try:
        text = line.decode("utf-8-sig").strip()
    except UnicodeDecodeError:
        raise MotionError(file, 1, "is not UTF-8 text; save the file as CSV, UTF-8") from None
    if not text:
        raise MotionError(file, 1, f"is empty; {_WANTED}")
    if ";" in text or "\t" in text:
        sign = "semicolons" if ";" in text else "tabs"
        raise MotionError(file, 1, f"the columns are separated by {sign}; use commas, and decimal points in numbers")
    names = split_line(text, 1, file)
    if names in (TIME_AND_POSITION, TIME_AND_POSITION + AXIS):
        return names
    raise MotionError(file, 1, f"{_difference(names)}; {_WANTED}")


def split_line(text: str, line: int, file: Path) -> list[str]:
    """The fields of a line of CSV."""
    try:
        return [field.strip() for field in next(csv.reader([text], skipinitialspace=True))]
    except csv.Error as bad:
        raise MotionError(file, line, f"is not CSV ({bad})") from None


def _difference(names: list[str]) -> str:
    if all(_is_number(name) for name in names):
        return "the first line holds numbers, not the names of the columns"
    known = TIME_AND_POSITION + AXIS
    wanted = known if set(names) & set(AXIS) else TIME_AND_POSITION
    parts = []
    twice = sorted({name for name in names if names.count(name) > 1})
    missing = [name for name in wanted if name not in names]
    unknown = [name for name in names if name not in known]
    if twice:
        parts.append(f"{_columns(twice)} appear{'s' * (len(twice) == 1)} twice")
    if missing:
        parts.append(f"{_columns(missing)} {'is' if len(missing) == 1 else 'are'} missing")
    for name in unknown:
        near = difflib.get_close_matches(name, missing, n=1)
        parts.append(f"column {name!r} is unknown" + (f" (did you mean {near[0]}?)" if near else ""))
    return ", ".join(parts) or f"the columns are in another order, {','.join(names)}"


def _columns(names: list[str]) -> str:
    return f"column{'s' * (len(names) != 1)} {', '.join(names)}"


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.ASCII | re.IGNORECASE)


def read_lines(block: bytes, first_line: int, columns: list[str], file: Path) -> NDArray[np.float64]:
    """The numbers of a block of lines, one row per line. Raises MotionError for the first invalid line."""
    rows = []
    for i, raw in enumerate(block.removesuffix(b"\n").split(b"\n")):
        line = first_line + i
        try:
            text = raw.decode("utf-8").strip()
        except UnicodeDecodeError:
            raise MotionError(file, line, "is not UTF-8 text; save the file as CSV, UTF-8") from None
        rows.append(_read_line(text, line, columns, file))
    return np.array(rows, dtype=np.float64)


def _read_line(text: str, line: int, columns: list[str], file: Path) -> list[float]:
    if not text:
        raise MotionError(file, line, "is empty; remove the line, or fill it in")
    fields = split_line(text, line, file)
    if len(fields) != len(columns):
        count = f"{len(fields)} value{'s' if len(fields) != 1 else ''} for {len(columns)} columns"
        hint = f"write one each for {','.join(columns)}"
        if ";" in text:
            hint = "use commas, and decimal points in numbers"
        elif len(fields) == 2 * len(columns):
            hint = "replace decimal commas by points"
        raise MotionError(file, line, f"holds {count}; {hint}")
    return [_read_number(field, name, line, file) for field, name in zip(fields, columns, strict=True)]


def _read_number(field: str, name: str, line: int, file: Path) -> float:
    if _NUMBER.fullmatch(field):
        value = float(field)
        if value in (float("inf"), float("-inf")):
            raise MotionError(file, line, f"{name} is {field}, which is too large for a number")
        return value
    if not field:
        raise MotionError(file, line, f"{name} is empty; fill the sample in, or cut the motion there")
    if _NOT_FINITE.fullmatch(field):
        raise MotionError(file, line, f"{name} is {field}; fill the sample in, or cut the motion there")
    if _NUMBER.fullmatch(field.replace(",", ".", 1)):
        raise MotionError(file, line, f"{name} is {field!r}, with a decimal comma; write {field.replace(',', '.', 1)}")
    raise MotionError(file, line, f"{name} is {field!r}, which is not a number")

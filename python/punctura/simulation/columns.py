"""Column names of a motion file."""

from __future__ import annotations

import csv
import difflib
from pathlib import Path

from punctura.simulation.motion_error import MotionError

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

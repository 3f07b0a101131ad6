"""Reads lines of numbers one by one. This is slow, but it finds the wrong line and the reason."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from punctura.simulation.columns import split_line
from punctura.simulation.motion_error import MotionError

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

"""The table of tick fields (core/punctura/servo/tick_table.hpp), and their column names in files."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache
from typing import NamedTuple

import numpy as np

from punctura._core import Phase, TickField, tick_fields

AXES = ("x", "y", "z")
ABSENT = 255  # phase of a membrane that a tick's scene does not have; its numbers are NaN
COMMAND_SCENE = 8  # bit of the field `commands`: this tick took a new scene

INSIDE = np.zeros(256, dtype=np.bool_)  # whether the membrane holds the needle, by the code of a phase
INSIDE[[Phase.sticking.value, Phase.sliding_in.value, Phase.sliding_out.value]] = True

FIELDS: Mapping[str, TickField] = {field.name: field for field in tick_fields()}


def shape_of(field: TickField, ticks: int, membranes: int) -> tuple[int, ...]:
    """The shape of a field's array: (n,), (n, 3), (n, m) or (n, m, 3)."""
    return (ticks, *[membranes] * field.per_membrane, *[field.width] * (field.width > 1))


class FileColumn(NamedTuple):
    """A column of a file: one component of a field, for one membrane if the field is per membrane."""

    name: str
    field: TickField
    membrane: int | None
    component: int | None  # None if the field is a single number


def file_columns(fields: Iterator[TickField] | list[TickField], membranes: int) -> Iterator[FileColumn]:
    """The columns in file order. Fields of the first membrane come first, then those of the next."""
    done = False
    fields = list(fields)
    each = [field for field in fields if field.per_membrane]
    for field in fields:
        if not field.per_membrane:
            yield from _columns(field, None)
        elif not done:
            done = True
            for i in range(membranes):
                for one in each:
                    yield from _columns(one, i)


def _columns(field: TickField, membrane: int | None) -> Iterator[FileColumn]:
    if field.width == 1:
        yield FileColumn(field.column.format(i=membrane), field, membrane, None)
        return
    for k, axis in enumerate(AXES):
        yield FileColumn(field.column.format(i=membrane, a=axis), field, membrane, k)


@cache
def _patterns() -> tuple[tuple[re.Pattern[str], TickField], ...]:
    """A pattern for the column names of each field."""

    def pattern(field: TickField) -> re.Pattern[str]:
        text = re.escape(field.column).replace(r"\{a\}", "(?P<a>[xyz])").replace(r"\{i\}", r"(?P<i>\d+)")
        return re.compile(text)

    return tuple((pattern(field), field) for field in FIELDS.values())


@cache
def file_column(name: str) -> FileColumn | None:
    """The field of a file's column; None for an unknown name."""
    for pattern, field in _patterns():
        if match := pattern.fullmatch(name):
            parts = match.groupdict()
            membrane = int(parts["i"]) if "i" in parts else None
            return FileColumn(name, field, membrane, AXES.index(parts["a"]) if "a" in parts else None)
    return None

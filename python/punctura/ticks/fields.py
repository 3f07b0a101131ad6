"""The table of tick fields (core/punctura/servo/tick_table.hpp), and their columns in files."""

from __future__ import annotations

import re
from collections.abc import ItemsView, Iterator, Mapping
from functools import cache
from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

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


Array = npt.NDArray[Any]


class Columns(Protocol):
    """Columns with one row per tick: Ticks or a dict."""

    def __getitem__(self, name: str, /) -> Array: ...
    def __contains__(self, name: object, /) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
    def items(self) -> ItemsView[str, Array]: ...
    def get(self, name: str, default: Any = None, /) -> Any: ...


def membrane_count(columns: Columns) -> int:
    """Number of membranes m: 1 for a single proxy, 0 without membrane columns."""
    for name, column in columns.items():
        if (field := FIELDS.get(name)) and field.per_membrane:
            return int(column.shape[1]) if column.ndim > (1 if field.width == 1 else 2) else 1
    return 0


def flatten(ticks: Columns, membranes: int | None = None) -> dict[str, Array]:
    """One array (n,) for each file column, in file order. membranes: number of membranes, default: those of `ticks`."""
    membranes = membrane_count(ticks) if membranes is None else membranes
    fields = [field for field in FIELDS.values() if field.name in ticks]
    flat = {}
    for column in file_columns(fields, membranes):
        values = _values(ticks, column)
        if values is not None:
            flat[column.name] = values
    flat.update({name: values for name, values in ticks.items() if name not in FIELDS})
    return flat


def _values(ticks: Columns, column: FileColumn) -> Array | None:
    """The numbers of a file's column; None for a component that the ticks of a Proxy1d do not have."""
    values = ticks[column.field.name]
    line = column.component is not None and (values.ndim == 1 or values.shape[-1] != 3)
    if column.component is not None:
        if line and column.component > 0:
            return None
        values = values if line else values[..., column.component]
    if column.membrane is None or values.ndim == 1:
        return values
    if column.membrane < values.shape[1]:
        return values[:, column.membrane]
    return np.full(len(values), np.nan if values.dtype.kind == "f" else ABSENT, values.dtype)


def gather(flat: Mapping[str, Array]) -> dict[str, Array]:
    """Collects file columns into fields. Other columns keep their names."""
    parts: dict[str, dict[tuple[int | None, int | None], Array]] = {}
    others = {}
    for name, values in flat.items():
        if column := file_column(name):
            parts.setdefault(column.field.name, {})[column.membrane, column.component] = values
        else:
            others[name] = values
    gathered = {name: _field(name, parts[name]) for name in FIELDS if name in parts}
    return {**gathered, **others}


def _field(name: str, parts: dict[tuple[int | None, int | None], Array]) -> Array:
    field = FIELDS[name]
    membranes = sorted({membrane for membrane, _ in parts if membrane is not None})

    def one(membrane: int | None) -> Array:
        if field.width == 1:
            return parts[membrane, None]
        if (membrane, 1) not in parts:  # ticks of a Proxy1d have one component
            return parts[membrane, 0]
        return np.stack([parts[membrane, k] for k in range(field.width)], axis=-1)

    return np.stack([one(i) for i in membranes], axis=1) if field.per_membrane else one(None)

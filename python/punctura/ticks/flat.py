"""Ticks as the columns of a file, and back."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from punctura.ticks.columns import Array, Columns, membrane_count
from punctura.ticks.fields import ABSENT, FIELDS, FileColumn, file_column, file_columns


def flatten(ticks: Columns, membranes: int | None = None) -> dict[str, Array]:
    """One array (n,) for each column of a file, in its order, for so many membranes; as many as there are if None."""
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
    """The numbers of a file's column; None for a component that a proxy on a line does not have."""
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
    """The fields of a file's columns, by their names; other columns keep theirs."""
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
        if (membrane, 1) not in parts:  # of a proxy on a line
            return parts[membrane, 0]
        return np.stack([parts[membrane, k] for k in range(field.width)], axis=-1)

    return np.stack([one(i) for i in membranes], axis=1) if field.per_membrane else one(None)

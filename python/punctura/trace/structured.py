"""Columns out of nested values: JSON, and the structures of a MAT file."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from punctura.trace.clock import clock_seconds, is_clock
from punctura.trace.decimals import numbers
from punctura.trace.encoding import encoding_of
from punctura.trace.heading import with_unit
from punctura.trace.reading import Reading
from punctura.trace.size import check_bytes, check_size
from punctura.trace.table import Table
from punctura.trace.trace import TraceError

Array = NDArray[np.float64]
_MOST_BYTES = 100_000_000  # a number of a JSON file takes some twenty times its size in memory


def read_json(path: Path, reading: Reading) -> Table:
    """A JSON file: columns as lists, or rows as objects or lists, in one value or one on each line (JSON Lines).

    {"units": {"depth": "mm"}} states units. Raises TraceError, OSError.
    """
    check_bytes(path, _MOST_BYTES, " of JSON")
    text = path.read_bytes().decode(encoding_of(path, reading.encoding).name, "replace")
    try:
        held = json.loads(text)
    except (ValueError, RecursionError) as whole:
        try:
            held = [json.loads(line) for line in text.splitlines() if line.strip()]
        except (ValueError, RecursionError):
            raise TraceError(f"{path}: is no JSON: {whole}. Export it again") from None
    units = held.get("units", {}) if isinstance(held, dict) else {}
    table = table_of(path, held)
    if not isinstance(units, dict):
        return table
    return Table({with_unit(name, str(units.get(name, ""))): column for name, column in table.items()})


def table_of(path: Path, held: Any) -> Table:
    """The longest columns of nested dictionaries, or the columns of the only matrix, by number. Raises TraceError."""
    columns: dict[str, Array] = {}
    matrices: list[Array] = []
    for name, value in _parts("", held):
        if value.ndim == 1:
            columns[name] = value
        else:
            matrices.append(value)
    if not columns and len(matrices) == 1:
        check_size(path, *matrices[0].shape)
        return Table({str(i + 1): column for i, column in enumerate(matrices[0].T)})
    if not columns:
        raise TraceError(f"{path}: holds neither vectors nor one matrix; save depth, force and time as one vector each")
    longest = max(len(column) for column in columns.values())
    check_size(path, longest, len(columns))
    return Table({name: column for name, column in columns.items() if len(column) == longest})


def _parts(name: str, value: Any) -> Iterator[tuple[str, Array]]:
    """The vectors and matrices in a value, with their names."""
    if isinstance(value, dict):
        if {"columns", "data"} <= set(value):  # as pandas writes it
            value = dict(zip(map(str, value["columns"]), zip(*value["data"], strict=True), strict=True))
        if value and all(str(key).isdigit() and not isinstance(inner, (dict, list)) for key, inner in value.items()):
            value = list(value.values())  # a column with the numbers of its rows
        else:
            for key, inner in value.items():
                yield from _parts(str(key), inner)
            return
    if isinstance(value, (list, tuple)) and value:
        if isinstance(value[0], dict):
            rows = [_flat(row) for row in value if isinstance(row, dict)]
            value = {key: [row.get(key) for row in rows] for key in rows[0]}
            yield from (part for key, inner in value.items() for part in _parts(key, inner))
            return
        if isinstance(value[0], (list, tuple)):
            value = np.array(value, dtype=np.float64) if len({len(row) for row in value}) == 1 else None
        elif is_clock(value):
            name, value = with_unit(name, "s"), clock_seconds(value)
        else:
            value = numbers(value)
    if isinstance(value, np.ndarray) and value.ndim in (1, 2) and value.dtype.kind in "biuf":
        yield name, value.astype(np.float64)


def _flat(row: Mapping[str, Any]) -> dict[str, Any]:
    """A row without objects in objects: `wrench.force.z`."""
    flat: dict[str, Any] = {}
    for key, value in row.items():
        inner = _flat(value) if isinstance(value, dict) else None
        flat |= {key: value} if inner is None else {f"{key}.{name}": part for name, part in inner.items()}
    return flat

"""Columns out of nested values: JSON, and the structures of a MAT file."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from punctura.trace.cells import column
from punctura.trace.decimals import numbers
from punctura.trace.encoding import encoding_of
from punctura.trace.heading import with_unit
from punctura.trace.reading import Reading, is_trace, only_trace, wanted_sheet
from punctura.trace.table import Table, check_bytes, check_size
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
    return table_of(path, held, reading)


def table_of(path: Path, held: Any, reading: Reading) -> Table:
    """The only object that holds a trace; else the longest columns of all, or those of the only matrix, by number.

    Raises TraceError.
    """
    objects: dict[str, dict[str, Array]] = {}
    matrices: list[Array] = []
    for where, name, value in _parts("", "", held, {}):
        if value.ndim == 1:
            objects.setdefault(where, {})[name] = value
        else:
            matrices.append(value)
    if not objects and len(matrices) == 1:
        check_size(path, *matrices[0].shape)
        return Table({str(i + 1): column for i, column in enumerate(matrices[0].T)})
    if not objects:
        text = "holds neither vectors of numbers nor one matrix; save depth, force and time as one vector each"
        raise TraceError(f"{path}: {text}")
    tables = {where or "the outermost": _longest(path, columns) for where, columns in objects.items()}
    if reading.sheet is not None:
        return tables[wanted_sheet(path, list(tables), reading.sheet)]
    if any(is_trace(table, reading) for table in tables.values()):
        return only_trace(path, tables, reading)
    names = [name for columns in objects.values() for name in columns]
    return _longest(
        path,
        {
            f"{where} {name}".strip() if names.count(name) > 1 else name: column
            for where, columns in objects.items()
            for name, column in columns.items()
        },
    )


def _longest(path: Path, columns: Mapping[str, Array]) -> Table:
    longest = max(len(column) for column in columns.values())
    check_size(path, longest, len(columns))
    return Table({name: column for name, column in columns.items() if len(column) == longest})


def _parts(where: str, name: str, value: Any, units: Mapping[str, Any]) -> Iterator[tuple[str, str, Array]]:
    """The vectors and matrices in a value: the object that holds each, its name, its numbers.

    where: the object of `value`. name: its key there. units: of the columns, by name.
    """
    here = f"{where}.{name}".strip(".")
    if isinstance(value, dict) and isinstance(value.get("columns"), list):  # as pandas writes it
        below = next((value[key] for key in ("data", "values", "rows") if isinstance(value.get(key), list)), None)
        value = value if below is None else [value["columns"], *below]
    if (
        isinstance(value, dict)
        and value
        and all(str(key).isdigit() and not isinstance(inner, (dict, list)) for key, inner in value.items())
    ):
        value = list(value.values())  # a column with the numbers of its rows
    if isinstance(value, dict) and isinstance(value.get("unit"), str):  # a column: {"unit": "mm", "values": [0, 1]}
        lists = [inner for inner in value.values() if isinstance(inner, list)]
        if len(lists) == 1:
            value, units = lists[0], {name: value["unit"]}
    if isinstance(value, dict):
        stated = value.get("units")
        units = {**units, **stated} if isinstance(stated, dict) else units
        for key, inner in value.items():
            yield from _parts(here, str(key), inner, units)
        return
    if isinstance(value, (list, tuple)) and value:
        if isinstance(value[0], dict):
            rows = [_flat(row) for row in value if isinstance(row, dict)]
            if any(isinstance(inner, (list, np.ndarray)) for inner in rows[0].values()):  # a trace in each
                for i, row in enumerate(rows, 1):
                    yield from _parts(here, str(i), row, units)
            else:
                for key in rows[0]:
                    yield from _parts(here, key, [row.get(key) for row in rows], units)
            return
        if isinstance(value[0], (list, tuple)):
            if len({len(row) if isinstance(row, (list, tuple)) else -1 for row in value}) != 1:
                return
            if all(isinstance(cell, str) for cell in value[0]):  # the names of the columns
                for key, *cells in zip(*value, strict=True):
                    yield from _parts(here, key, cells, units)
                return
            value = np.array([numbers(row) for row in value])
        else:
            name, value = column(with_unit(name, str(units.get(name, ""))), value)
            if not np.isfinite(value).any():  # texts
                return
    if isinstance(value, np.ndarray) and value.ndim in (1, 2) and value.dtype.kind in "biuf":
        yield where, with_unit(name, str(units.get(name, ""))), value.astype(np.float64)


def _flat(row: Mapping[str, Any]) -> dict[str, Any]:
    """A row without objects in objects: `wrench.force.z`."""
    flat: dict[str, Any] = {}
    for key, value in row.items():
        inner = _flat(value) if isinstance(value, dict) else None
        flat |= {key: value} if inner is None else {f"{key}.{name}": part for name, part in inner.items()}
    return flat

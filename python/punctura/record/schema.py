"""Types of a recording's columns: as numbers while it is written, with words in place of codes when it is read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from punctura.record.columns import AXES, LOST, NEW_SCENES, Columns, words_of
from punctura.record.errors import RecordingError

SCENES_TYPE = pa.list_(pa.string())
_WORD = pa.dictionary(pa.int8(), pa.string())
NO_PHASE = 255
_ROWS_A_PIECE = 2048


def raw_batch(flat: Columns, lost: NDArray[np.uint32], scenes: list[list[str] | None]) -> pa.RecordBatch:
    """A batch as it is written while a loop runs. NaN of a membrane that is not there is null."""
    arrays = {name: _array(name, column) for name, column in flat.items()}
    arrays[LOST] = pa.array(lost)
    arrays[NEW_SCENES] = pa.array(scenes, type=SCENES_TYPE)
    return pa.RecordBatch.from_arrays(list(arrays.values()), names=list(arrays))


def _array(name: str, column: NDArray[Any]) -> pa.Array:
    values = np.ascontiguousarray(column)
    if name.startswith("phase_"):
        return pa.array(values, mask=values == NO_PHASE)
    if of_membrane(name):
        return pa.array(values, mask=np.isnan(values))
    return pa.array(values)


def of_membrane(name: str) -> bool:
    """Whether a column belongs to one membrane: depth_0_m, proxy_1_x_m."""
    parts = name.split("_")
    return len(parts) > 1 and parts[1].isdigit()


def membranes_in(schema: pa.Schema) -> int:
    """How many membranes the columns are for."""
    return sum(name.startswith("phase_") for name in schema.names)


# Columns that every recording has; a membrane's are there once for each.
_INTEGERS = ("tick", "commands", "sequence", "buttons", LOST)
_FLOATS = (
    "time_s",
    "motor_temperature",
    "ceiling_N",
    *(p.format(a) for a in AXES for p in ("{}_m", "axis_{}", "f{}_N")),
)
_OTHERS = ("healthy", "state", "fault", NEW_SCENES)
_EACH = ("depth_{}_m", "force_{}_N", "lower_{}_N", "upper_{}_N", "phase_{}")


def check_columns(schema: pa.Schema, path: Path) -> None:
    """Raises RecordingError where columns of a recording are missing or hold something else than they should."""
    each = [pattern.format(i) for i in range(membranes_in(schema)) for pattern in _EACH]
    missing = [name for name in (*_INTEGERS, *_FLOATS, *_OTHERS, *each) if schema.names.count(name) != 1]
    wrong = [f"{field.name} ({field.type})" for field in schema if not _fits(field)]
    if missing or wrong:
        reasons = [f"without {', '.join(missing)}"] * bool(missing) + [f"with {', '.join(wrong)}"] * bool(wrong)
        raise RecordingError(f"{path}: the columns are not those of a recording: {' and '.join(reasons)}")


def _fits(field: pa.Field) -> Any:
    if field.name == NEW_SCENES:
        return pa.types.is_list(field.type) and pa.types.is_string(field.type.value_type)
    if words_of(field.name):
        kind = field.type.value_type if pa.types.is_dictionary(field.type) else field.type
        return pa.types.is_uint8(kind) or pa.types.is_string(kind)
    if field.name in _INTEGERS:
        return pa.types.is_integer(field.type)
    if field.name in _FLOATS or of_membrane(field.name):
        return pa.types.is_float64(field.type)
    return pa.types.is_primitive(field.type)


def in_pieces(batches: Iterable[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
    """The same ticks, few at once: as text they take many times the memory."""
    for batch in batches:
        for at in range(0, len(batch), _ROWS_A_PIECE):
            yield batch.slice(at, _ROWS_A_PIECE)


def read_schema(raw: pa.Schema) -> pa.Schema:
    """The columns as a reader sees them."""
    return pa.schema([pa.field(f.name, _WORD if words_of(f.name) else f.type) for f in raw])


def worded(batch: pa.RecordBatch, schema: pa.Schema) -> pa.RecordBatch:
    """A raw batch under a reader's schema: words for codes; a column that it does not have is null."""
    arrays = []
    for field in schema:
        index = batch.schema.get_field_index(field.name)
        words = words_of(field.name)
        if index < 0:
            arrays.append(pa.nulls(len(batch), field.type))
        elif words is not None and batch.schema.field(index).type == pa.uint8():
            codes = batch.column(index).cast(pa.int8())
            arrays.append(pa.DictionaryArray.from_arrays(codes, pa.array(words), safe=True))
        else:
            arrays.append(batch.column(index))
    return pa.RecordBatch.from_arrays(arrays, schema=schema)


def numbers(batch: pa.RecordBatch, name: str) -> NDArray[Any]:
    """A column as numbers for a computation: null is NaN, or 255 for a word's code."""
    column = batch.column(name)
    words = words_of(name)
    if words is not None and not pa.types.is_integer(column.type):
        import pyarrow.compute as pc

        codes = pc.index_in(column.cast(pa.string()), value_set=pa.array(words)).fill_null(NO_PHASE)
        return np.asarray(codes.to_numpy(zero_copy_only=False)).astype(np.uint8)
    if pa.types.is_floating(column.type):
        return np.asarray(column.to_numpy(zero_copy_only=False))
    return np.asarray(column.to_numpy(zero_copy_only=False))

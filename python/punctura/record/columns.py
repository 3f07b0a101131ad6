"""The columns of a recording: names and types. Codes are numbers when it is written and words when it is read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from punctura.record.description import RecordingError
from punctura.ticks import ABSENT, FIELDS, Ticks
from punctura.ticks.arrow import WORD, arrays, number_type, with_words, words_of
from punctura.ticks.fields import file_column, file_columns, flatten, gather

LOST = "lost"  # number of ticks missing between the previous row and this one
NEW_SCENES = "new_scenes"  # the scenes taken before this tick's step, as TOML; null if none

INPUTS = [field.name for field in FIELDS.values() if field.input]  # the inputs of a tick
SCENES_TYPE = pa.list_(pa.string())
_ROWS_A_PIECE = 2048
# Fields that earlier versions did not record, and their value in those runs: the whole force, and no syringe.
_NO_SYRINGE = ("plunger", "thumb_force", "pressure", "injected")
_LATER = {"thumb": 0.0, "thumb_felt": 0.0, "force_scale": 1.0} | dict.fromkeys(_NO_SYRINGE, np.nan)
# Required fields. Earlier versions did not record all of the others.
_EARLIER_INPUTS = [name for name in INPUTS if name not in _LATER]
_RESULTS = ("tick", "ceiling", "force", "state", "fault", "depth", "axial_force", "lower", "upper", "phase")
_REQUIRED = (*_EARLIER_INPUTS, *_RESULTS)


def raw_batch(ticks: Ticks, membranes: int, lost: NDArray[np.uint32], scenes: list[list[str] | None]) -> pa.RecordBatch:
    """A batch for the .part file, with columns for `membranes` membranes. Absent values are null."""
    columns = arrays(flatten(ticks, membranes))
    columns[LOST] = pa.array(lost)
    columns[NEW_SCENES] = pa.array(scenes, type=SCENES_TYPE)
    return pa.RecordBatch.from_arrays(list(columns.values()), names=list(columns))


def membranes_in(schema: pa.Schema) -> int:
    """Number of membranes in the columns."""
    numbers_of = [column.membrane for name in schema.names if (column := file_column(name))]
    return max((i + 1 for i in numbers_of if i is not None), default=0)


def check_columns(schema: pa.Schema, path: Path) -> None:
    """Raises RecordingError if columns are missing or have a wrong type."""
    fields = [FIELDS[name] for name in _REQUIRED]
    required = [column.name for column in file_columns(fields, membranes_in(schema))] + [LOST, NEW_SCENES]
    missing = [name for name in required if schema.names.count(name) != 1]
    wrong = [f"{field.name} ({field.type})" for field in schema if not _fits(field)]
    if missing or wrong:
        reasons = [f"without {', '.join(missing)}"] * bool(missing) + [f"with {', '.join(wrong)}"] * bool(wrong)
        raise RecordingError(f"{path}: wrong columns for a recording: {' and '.join(reasons)}")


def _fits(field: pa.Field) -> bool:
    if field.name == NEW_SCENES:
        return bool(pa.types.is_list(field.type) and pa.types.is_string(field.type.value_type))
    expected = number_type(field.name)
    if words_of(field.name):
        kind = field.type.value_type if pa.types.is_dictionary(field.type) else field.type
        return bool(pa.types.is_uint8(kind) or pa.types.is_string(kind))
    if field.name == LOST or (expected is not None and pa.types.is_integer(expected)):
        return bool(pa.types.is_integer(field.type))
    if expected is not None and pa.types.is_floating(expected):
        return bool(pa.types.is_float64(field.type))
    return bool(pa.types.is_primitive(field.type))


def in_pieces(batches: Iterable[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
    """Splits batches into small pieces, because text needs many times the memory."""
    for batch in batches:
        for at in range(0, len(batch), _ROWS_A_PIECE):
            yield batch.slice(at, _ROWS_A_PIECE)


def read_schema(raw: pa.Schema) -> pa.Schema:
    """The schema with words in place of codes."""
    return pa.schema([pa.field(f.name, WORD if words_of(f.name) else f.type) for f in raw])


def worded(batch: pa.RecordBatch, schema: pa.Schema) -> pa.RecordBatch:
    """Converts a raw batch to a reader's schema: codes become words, missing columns become null."""
    arrays = []
    for field in schema:
        index = batch.schema.get_field_index(field.name)
        if index < 0:
            arrays.append(pa.nulls(len(batch), field.type))
        elif words_of(field.name) and batch.schema.field(index).type == pa.uint8():
            arrays.append(with_words(field.name, batch.column(index)))
        else:
            arrays.append(batch.column(index))
    return pa.RecordBatch.from_arrays(arrays, schema=schema)


def numbers(batch: pa.RecordBatch, name: str) -> NDArray[Any]:
    """A column as numbers. null becomes NaN, or ABSENT for a code."""
    column = batch.column(name)
    words = words_of(name)
    if words is not None and not pa.types.is_integer(column.type):
        import pyarrow.compute as pc

        column = pc.index_in(column.cast(pa.string()), value_set=pa.array(words)).fill_null(ABSENT)
    elif words is not None:
        column = column.fill_null(ABSENT)
    values = np.asarray(column.to_numpy(zero_copy_only=False))
    return values.astype(np.uint8) if words is not None else values


def input_ticks(batch: pa.RecordBatch) -> Ticks:
    """The inputs of the ticks in a batch."""
    wanted = [column.name for column in file_columns([FIELDS[name] for name in ("tick", *INPUTS)], 0)]
    known = set(batch.schema.names)
    ticks = Ticks(gather({name: numbers(batch, name) for name in wanted if name in known}))
    return _with_later(ticks, [name for name in INPUTS if name in _LATER])


def ticks_of(batch: pa.RecordBatch) -> Ticks:
    """The ticks of a batch. A membrane that a tick did not have is NaN, its phase ABSENT."""
    ticks = Ticks(gather({f.name: numbers(batch, f.name) for f in batch.schema if f.name != NEW_SCENES}))
    ticks = _with_later(ticks, _LATER)
    if "limit" in ticks:
        return ticks
    return ticks.replace(limit=np.full(len(batch), ABSENT, np.uint8))  # format 1 has no `limit`


def _with_later(ticks: Ticks, names: Iterable[str]) -> Ticks:
    """The ticks with those of these fields that an earlier version did not record."""
    return ticks.replace(**{name: np.full(len(ticks), _LATER[name]) for name in names if name not in ticks})

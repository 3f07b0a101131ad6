"""Converts ticks to Arrow tables, with words in place of codes."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa

from punctura.ticks.columns import Columns
from punctura.ticks.fields import ABSENT, file_column
from punctura.ticks.flat import flatten

WORD = pa.dictionary(pa.int8(), pa.string())


def words_of(column: str) -> list[str] | None:
    """The words for the codes of a file's column; None for a column of plain numbers."""
    known = file_column(column)
    return known.field.words if known else None


def number_type(column: str) -> pa.DataType | None:
    """The number type of a file's column, words aside; None for an unknown name."""
    known = file_column(column)
    return pa.from_numpy_dtype(np.dtype(known.field.dtype)) if known else None


def array(column: str, values: npt.NDArray[Any]) -> pa.Array:
    """An Arrow array of numbers. Values of an absent membrane are null."""
    known = file_column(column)
    values = np.ascontiguousarray(values)
    if known is None or known.membrane is None:
        return pa.array(values)
    absent = values == ABSENT if known.field.words else np.isnan(values)
    return pa.array(values, mask=absent if absent.any() else None)  # without a mask Arrow does not copy


def with_words(column: str, codes: pa.Array) -> pa.Array:
    """Replaces codes by words, if the column has words."""
    words = words_of(column)
    if words is None:
        return codes
    return pa.DictionaryArray.from_arrays(codes.cast(pa.int8()), pa.array(words), safe=True)


def to_arrow(ticks: Columns, words: bool = True) -> pa.Table:
    """See Ticks.to_arrow. Of columns outside the tick table, only those with one number per tick are included."""
    flat = {name: array(name, values) for name, values in flatten(ticks).items() if values.ndim == 1}
    return pa.table({name: with_words(name, values) if words else values for name, values in flat.items()})

"""Ticks as Arrow tables: numbers, with words in place of codes."""

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
    """The words that the numbers of a file's column stand for; None for a column of plain numbers."""
    known = file_column(column)
    return known.field.words if known else None


def number_type(column: str) -> pa.DataType | None:
    """The type of a file's column, without words; None for a name that the table does not give."""
    known = file_column(column)
    return pa.from_numpy_dtype(np.dtype(known.field.dtype)) if known else None


def array(column: str, values: npt.NDArray[Any]) -> pa.Array:
    """Numbers. What is absent of a membrane is null."""
    known = file_column(column)
    values = np.ascontiguousarray(values)
    if known is None or known.membrane is None:
        return pa.array(values)
    absent = values == ABSENT if known.field.words else np.isnan(values)
    return pa.array(values, mask=absent if absent.any() else None)  # without a mask, Arrow makes no copy


def with_words(column: str, codes: pa.Array) -> pa.Array:
    """Words in place of codes, where the column has words."""
    words = words_of(column)
    if words is None:
        return codes
    return pa.DictionaryArray.from_arrays(codes.cast(pa.int8()), pa.array(words), safe=True)


def to_arrow(ticks: Columns, words: bool = True) -> pa.Table:
    """See Ticks.to_arrow. Of other columns only those with one number a tick."""
    flat = {name: array(name, values) for name, values in flatten(ticks).items() if values.ndim == 1}
    return pa.table({name: with_words(name, values) if words else values for name, values in flat.items()})

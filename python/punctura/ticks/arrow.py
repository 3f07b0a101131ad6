"""Converts ticks to Arrow tables, with words in place of codes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa

from punctura.ticks.fields import ABSENT, FIELDS, Columns, file_column, flatten

WORD = pa.dictionary(pa.int8(), pa.string())
_PHASE = FIELDS["phase"].column


def words_of(column: str) -> list[str] | None:
    """The words for the codes of a file's column; None for a column of plain numbers."""
    known = file_column(column)
    return known.field.words if known else None


def number_type(column: str) -> pa.DataType | None:
    """The number type of a file's column, words aside; None for an unknown name."""
    known = file_column(column)
    return pa.from_numpy_dtype(np.dtype(known.field.dtype)) if known else None


def arrays(flat: Mapping[str, npt.NDArray[Any]]) -> dict[str, pa.Array]:
    """The columns of a file. A membrane is absent from a tick if its phase is ABSENT; then its fields are null."""
    return {name: _array(name, values, flat) for name, values in flat.items() if values.ndim == 1}


def _array(column: str, values: npt.NDArray[Any], flat: Mapping[str, npt.NDArray[Any]]) -> pa.Array:
    known = file_column(column)
    values = np.ascontiguousarray(values)
    absent = None
    if known is not None and known.membrane is not None:
        phase = flat.get(_PHASE.format(i=known.membrane))
        absent = None if phase is None else phase == ABSENT
    elif known is not None and known.field.words:  # earlier recordings do not have every field
        absent = values == ABSENT
    return pa.array(values, mask=absent if absent is not None and absent.any() else None)  # no mask, no copy


def with_words(column: str, codes: pa.Array) -> pa.Array:
    """Replaces codes by words, if the column has words."""
    words = words_of(column)
    if words is None:
        return codes
    return pa.DictionaryArray.from_arrays(codes.view(pa.int8()), pa.array(words), safe=True)


def to_arrow(ticks: Columns, words: bool = True) -> pa.Table:
    """See Ticks.to_arrow. Of columns outside the tick table, only those with one number per tick are included."""
    return pa.table({n: with_words(n, values) if words else values for n, values in arrays(flatten(ticks)).items()})

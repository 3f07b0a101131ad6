"""The common interface of Ticks and a plain dict: arrays by field name."""

from __future__ import annotations

from collections.abc import ItemsView, Iterator
from typing import Any, Protocol

import numpy.typing as npt

from punctura.ticks.fields import FIELDS

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

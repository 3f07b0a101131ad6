"""Arrays by the names of fields: what Ticks and a plain dict have in common."""

from __future__ import annotations

from collections.abc import ItemsView, Iterator
from typing import Any, Protocol

import numpy.typing as npt

from punctura.ticks.fields import FIELDS

Array = npt.NDArray[Any]


class Columns(Protocol):
    """One row a tick. Ticks is one, and so is a dict."""

    def __getitem__(self, name: str, /) -> Array: ...
    def __contains__(self, name: object, /) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
    def items(self) -> ItemsView[str, Array]: ...
    def get(self, name: str, otherwise: Any = None, /) -> Any: ...


def membrane_count(columns: Columns) -> int:
    """m; 1 for a single proxy, 0 for columns without a membrane."""
    for name, column in columns.items():
        if (field := FIELDS.get(name)) and field.per_membrane:
            return int(column.shape[1]) if column.ndim > (1 if field.width == 1 else 2) else 1
    return 0

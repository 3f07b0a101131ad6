"""A file in memory whose content is taken away piece by piece.

It stands alone, without an import from this package: Arrow may hold it until after the interpreter's end.
"""

from __future__ import annotations

from typing import Any


class Collected:
    """A file that keeps what is written until it is asked for."""

    closed = False

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._written = 0

    def write(self, data: Any) -> int:
        self._parts.append(bytes(data))
        self._written += len(self._parts[-1])
        return len(self._parts[-1])

    def tell(self) -> int:
        return self._written

    def take(self) -> bytes:
        data = b"".join(self._parts)
        self._parts = []
        return data

    def flush(self) -> None: ...

    def close(self) -> None: ...

    def writable(self) -> bool:
        return True

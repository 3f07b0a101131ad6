"""An in-memory file whose content is read out piece by piece.

This module imports nothing from this package, because Arrow may hold the file until after the interpreter exits.
"""

from typing import Any


class Collected:
    """A write-only file that keeps its content until take()."""

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

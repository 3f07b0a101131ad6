"""A file that only grows, and is whole up to its last whole write."""

from __future__ import annotations

import os
from pathlib import Path


class AppendFile:
    """Made anew; what stands there already is never overwritten. A write that fails can be tried again."""

    def __init__(self, path: Path) -> None:
        self._descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666)
        self.size = 0  # of what was written in whole

    def write(self, data: bytes) -> None:
        """All of it, or an OSError; what a failed write has left is overwritten by the next."""
        os.lseek(self._descriptor, self.size, os.SEEK_SET)
        rest = memoryview(data)
        while rest:
            rest = rest[os.write(self._descriptor, rest) :]
        self.size += len(data)

    def close(self) -> None:
        """Cuts off what a failed write has left."""
        try:
            os.ftruncate(self._descriptor, self.size)
        finally:
            os.close(self._descriptor)

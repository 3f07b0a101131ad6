"""The exception for invalid motion files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from punctura._core import PuncturaError

TABLES = (".parquet", ".npy", ".npz")  # files without lines of text


class MotionError(PuncturaError, ValueError):
    """An invalid motion file. Names the file, the line or row (0 for the whole file), the problem and the remedy."""

    def __init__(self, file: str | Path, line: int, what: str) -> None:
        self.file = str(file)
        self.line = line
        self.what = what
        place = "line" if Path(file).suffix.lower() not in TABLES else "row"
        super().__init__(f"{file}, {place} {line}: {what}" if line else f"{file}: {what}")

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.file, self.line, self.what)

"""Names of files as text."""

from __future__ import annotations

import os


def as_text(path: str | os.PathLike[str]) -> str:
    """A path as text that can be written anywhere: bytes of a name that are no UTF-8 become question marks."""
    return os.fsencode(path).decode("utf-8", "replace")

"""Files and folders with data of a person: their owner alone can read them, whatever the folder and the umask."""

from __future__ import annotations

import os
from pathlib import Path

MODE = 0o600


def private(path: str, flags: int) -> int:
    """An `opener` for `open`: a new file is private from its first moment."""
    return os.open(path, flags, MODE)


def private_folder(path: Path) -> None:
    """Makes a folder and those above it. An existing one stays as it is: its owner may have shared it on purpose."""
    path.mkdir(0o700, parents=True, exist_ok=True)

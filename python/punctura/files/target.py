"""Whether a file can be written, before a computation whose result it is to hold."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path


def target_problems(target: Path, suffixes: Sequence[str] = ()) -> list[str]:
    """Why no file can be written at this path. suffixes: those that it may have; default: any."""
    problems = []
    if suffixes and target.suffix.lower() not in suffixes:
        problems.append(f"must end in {' or '.join(suffixes)}")
    if target.is_dir():
        problems.append("is a folder; name a file")
    elif not target.parent.is_dir():
        problems.append(f"there is no folder {target.parent}; make it first")
    elif not os.access(target.parent, os.W_OK):
        problems.append("its folder may not be written; choose another")
    return problems


def same_file(one: Path, other: Path) -> bool:
    """Whether both exist and are one file."""
    return one.exists() and other.exists() and one.samefile(other)

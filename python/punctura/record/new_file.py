"""Creates growing recordings that get their name once their beginning is written: a kill leaves no empty file."""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable
from pathlib import Path
from typing import Literal

from punctura.files.whole_file import give_name, rename_new, unnamed_file
from punctura.record.errors import RecordingError
from punctura.record.lock import in_use, lock
from punctura.record.part_file import PartFile

_MOST_WITHOUT_TICK = 1 << 20  # bytes of a header, and of a first batch whose write was cut short by a kill
_TRIES = 100
_Left = Literal["no tick", "damaged", "other"]


def make_file(path: Path, begin: Callable[[int], None]) -> tuple[int, Path | None]:
    """The descriptor of a new, locked file, and where a damaged file is now that stood in its place, if one did.

    `begin` writes the beginning. What a killed process left at `path` makes room where it holds no tick that can be
    read and no process holds it: it is removed, or renamed if it is damaged inside. Raises FileExistsError for
    anything else that is there, OSError.
    """
    aside = None
    for _ in range(_TRIES):
        try:
            return _make(path, begin), aside
        except FileExistsError:
            aside = _remove_abandoned(path) or aside
    raise FileExistsError(path)


def _make(path: Path, begin: Callable[[int], None]) -> int:
    descriptor = unnamed_file(path.parent)
    if descriptor is None:
        return _make_named(path, begin)
    try:
        lock(descriptor)
        begin(descriptor)
        if give_name(descriptor, path):
            return descriptor
    except BaseException:
        os.close(descriptor)
        raise
    os.close(descriptor)
    return _make_named(path, begin)


def _make_named(path: Path, begin: Callable[[int], None]) -> int:
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666)
    try:
        lock(descriptor)
        begin(descriptor)
    except BaseException:
        os.close(descriptor)
        path.unlink(missing_ok=True)
        raise
    return descriptor


def _remove_abandoned(path: Path) -> Path | None:
    """A damaged file's new name. Raises FileExistsError where a process holds it, it holds ticks, or is not ours."""
    if path.is_symlink() or not path.is_file():
        raise FileExistsError(path)
    try:
        descriptor = os.open(path, os.O_RDWR)
    except FileNotFoundError:
        return None
    except OSError:
        raise FileExistsError(path) from None
    try:
        if lock(descriptor) is not True:
            raise FileExistsError(path)
        # Another process may have removed it, and begun its own, before this one had the lock.
        if not _is_at(descriptor, path):
            return None
        left = _left(path)
        if left == "other":
            raise FileExistsError(path)
        if os.name == "posix":
            return _clear(path, left)
    finally:
        os.close(descriptor)
    return _clear(path, left)  # Windows removes no file that is open


def _clear(path: Path, left: _Left) -> Path | None:
    """Removes the file; a damaged one gets another name, which is returned."""
    aside = None
    if left == "damaged":
        aside = path.with_name(f"{path.name}.{secrets.token_hex(4)}.damaged")
        rename_new(path, aside)
    path.unlink(missing_ok=True)
    return aside


def _is_at(descriptor: int, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(descriptor), os.stat(path))
    except FileNotFoundError:
        return False


def is_abandoned(path: Path) -> bool:
    """Whether a growing recording blocks no name: no process holds it, and no tick of it can be read."""
    return path.is_file() and not path.is_symlink() and not in_use(path) and _left(path) != "other"


def _left(path: Path) -> _Left:
    """What a killed process left.

    no tick: an empty file, or a recording whose first tick was not yet whole on the disk. damaged: no tick of it can be
    read, but it holds more than one batch that was cut off.
    """
    try:
        size = path.stat().st_size
        if size == 0:
            return "no tick"
        if size > _MOST_WITHOUT_TICK:
            return "other"
        part = PartFile(path)
    except (RecordingError, OSError, MemoryError):
        return "other"
    if part.survey.rows or part.damaged_parts:
        return "other"
    return "damaged" if part.damaged else "no tick"

"""Creates .part files, which their owner alone can read, and locks them while they are written.

A file gets its name only after its first bytes are written, so a kill leaves no empty file. The system releases the
lock when the process ends, so it shows whether a process still writes the file.
"""

import os
import secrets
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Literal

from punctura.files.whole_file import MODE, give_name, rename_new, unnamed_file
from punctura.record.description import RecordingError
from punctura.record.part_file import PartFile

if sys.platform == "win32":
    import msvcrt

    _AT = 1 << 40  # beyond the end of any recording, because Windows blocks reads of a locked byte

    def _lock(descriptor: int) -> None:
        os.lseek(descriptor, _AT, os.SEEK_SET)
        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
else:
    import fcntl

    def _lock(descriptor: int) -> None:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)


def lock(descriptor: int) -> bool | None:
    """Locks an open file until it is closed; returns True on success.

    False: another process, or another descriptor of this process, holds the lock. None: this file system has no locks.
    """
    try:
        _lock(descriptor)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:
        return None
    return True


def in_use(path: Path) -> bool:
    """Whether a recorder holds this file. False if that cannot be determined."""
    try:
        descriptor = os.open(path, os.O_RDWR)
    except OSError:
        return False
    try:
        return lock(descriptor) is False
    finally:
        os.close(descriptor)


_MOST_WITHOUT_TICK = 1 << 20  # bytes: a header and an incomplete first batch are smaller
_TRIES = 100
_Left = Literal["no tick", "damaged", "other"]


def make_file(path: Path, begin: Callable[[int], None]) -> tuple[int, Path | None]:
    """The descriptor of a new, locked file, and the new path of a damaged file that had its name (None if none had).

    `begin` writes the first bytes. A file of a killed process at `path` without a readable tick gives way: it is
    removed, or renamed if it is damaged inside. Raises FileExistsError for any other existing file, and OSError.
    """
    aside = None
    for _ in range(_TRIES):
        try:
            return _make(path, begin), aside
        except FileExistsError:
            aside = _remove_abandoned(path) or aside
    raise FileExistsError(path)


def _make(path: Path, begin: Callable[[int], None]) -> int:
    descriptor = unnamed_file(path.parent, MODE)
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
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), MODE)
    try:
        lock(descriptor)
        begin(descriptor)
    except BaseException:
        os.close(descriptor)
        path.unlink(missing_ok=True)
        raise
    return descriptor


def _remove_abandoned(path: Path) -> Path | None:
    """Removes an abandoned file, or renames a damaged one and returns its new path.

    Raises FileExistsError if a process holds it, if it has readable ticks, or if it is not a recording.
    """
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
        # Before this process got the lock, another one may have replaced the file.
        if not _is_at(descriptor, path):
            return None
        left = _left(path)
        if left == "other":
            raise FileExistsError(path)
        if os.name == "posix":
            return _clear(path, left)
    finally:
        os.close(descriptor)
    return _clear(path, left)  # Windows cannot remove an open file


def _clear(path: Path, left: _Left) -> Path | None:
    """Removes the file. Renames a damaged one instead and returns its new path."""
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
    """Whether a .part file can be replaced: no process holds it, and it has no readable tick."""
    return path.is_file() and not path.is_symlink() and not in_use(path) and _left(path) != "other"


def _left(path: Path) -> _Left:
    """Classifies the file of a killed process.

    no tick: an empty file, or a recording whose first batch is incomplete. damaged: no readable tick, but more data
    than one incomplete batch.
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

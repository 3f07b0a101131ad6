"""New files that have their name only once their beginning, or all of them, is written: a kill leaves no empty file."""

from __future__ import annotations

import errno
import os
import secrets
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal

from punctura.record.errors import RecordingError
from punctura.record.lock import in_use, lock
from punctura.record.part_file import PartFile

_NO_UNNAMED = (errno.EOPNOTSUPP, errno.EISDIR, errno.EINVAL)
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


@contextmanager
def whole_file(path: Path, replace: bool) -> Iterator[str]:
    """Where to write a file that gets its name when it is whole and on the disk; after an error there is nothing.

    replace: whether it may take the place of another file; if not, raises FileExistsError. Where the system has files
    without a name, a kill leaves nothing, else a hidden file.
    """
    hidden = path.with_name(f".{path.name}.{secrets.token_hex(4)}.part")
    descriptor = _unnamed(path.parent)
    try:
        yield str(hidden) if descriptor is None else f"/proc/self/fd/{descriptor}"
        _sync(hidden) if descriptor is None else os.fsync(descriptor)
        if descriptor is not None and not _give_name(descriptor, hidden):
            raise OSError(errno.EOPNOTSUPP, os.strerror(errno.EOPNOTSUPP), str(path))
        if replace:
            os.replace(hidden, path)
        else:
            _rename(hidden, path)
    finally:
        if descriptor is not None:
            os.close(descriptor)
        hidden.unlink(missing_ok=True)


def _sync(file: Path) -> None:
    descriptor = os.open(file, os.O_RDWR)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _rename(file: Path, path: Path) -> None:
    """Overwrites nothing, also where another program makes a file of this name in the same moment."""
    try:
        os.link(file, path)
    except FileExistsError:
        raise
    except OSError:  # a file system without second names
        if path.exists():
            raise FileExistsError(path) from None
        os.replace(file, path)


def _make(path: Path, begin: Callable[[int], None]) -> int:
    descriptor = _unnamed(path.parent)
    if descriptor is None:
        return _make_named(path, begin)
    try:
        lock(descriptor)
        begin(descriptor)
        if _give_name(descriptor, path):
            return descriptor
    except BaseException:
        os.close(descriptor)
        raise
    os.close(descriptor)
    return _make_named(path, begin)


def _give_name(descriptor: int, path: Path) -> bool:
    """False where the system does not do it. Raises FileExistsError."""
    try:
        # With src_dir_fd, though an absolute path has no use for it: only then Python follows the link in /proc.
        os.link(f"/proc/self/fd/{descriptor}", path, src_dir_fd=descriptor)
    except FileExistsError:
        raise
    except OSError:
        return False
    return True


def _unnamed(folder: Path) -> int | None:
    """A file without a name, which is gone when it is closed; None where the system has none."""
    if not hasattr(os, "O_TMPFILE") or not os.path.isdir("/proc/self/fd"):
        return None
    try:
        return os.open(folder, os.O_TMPFILE | os.O_RDWR, 0o666)
    except OSError as error:
        if error.errno in _NO_UNNAMED:
            return None
        raise


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
        _rename(path, aside)
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

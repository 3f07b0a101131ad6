"""Writes files: checks the path first, and a file appears only when it is complete."""

import errno
import os
import secrets
import stat
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

MODE = 0o600  # of files with data of a person: their owner alone can read them, whatever the folder and the umask
_NO_UNNAMED = (errno.EOPNOTSUPP, errno.EISDIR, errno.EINVAL)


def private(path: str, flags: int) -> int:
    """An `opener` for `open`: a new file is private from its first moment."""
    return os.open(path, flags, MODE)


def private_folder(path: Path) -> None:
    """Makes a folder and those above it. An existing one stays as it is: its owner may have shared it on purpose."""
    path.mkdir(0o700, parents=True, exist_ok=True)


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


@contextmanager
def whole_file(path: Path, replace: bool = True, private: bool = False) -> Iterator[str]:
    """Yields the path to write to. At the end of the block the file is renamed to `path`.

    replace: whether to replace an existing file, whose permissions are kept; if False, raises FileExistsError.
    private: a new file is readable by its owner alone. Raises OSError with `path` as its filename. A killed process
    leaves nothing on systems with unnamed files, and a hidden file on others.
    """
    mode = MODE if private else 0o666
    hidden = path.with_name(f".{path.name}.{secrets.token_hex(4)}.part")
    place, descriptor = str(hidden), None
    try:
        descriptor = unnamed_file(path.parent, mode)
        if descriptor is None:
            os.close(os.open(hidden, os.O_CREAT | os.O_EXCL | os.O_WRONLY, mode))
        else:
            place = f"/proc/self/fd/{descriptor}"
        yield place
        if replace and path.is_file():
            os.chmod(place, stat.S_IMODE(path.stat().st_mode))
        sync(hidden) if descriptor is None else os.fsync(descriptor)
        if descriptor is not None and not give_name(descriptor, hidden):
            raise OSError(errno.EOPNOTSUPP, os.strerror(errno.EOPNOTSUPP), str(path))
        if replace:
            os.replace(hidden, path)
        else:
            rename_new(hidden, path)
    except OSError as error:
        internal = error.filename is None or str(error.filename) in (place, str(hidden), str(path.parent))
        if error.errno is None or not internal:
            raise
        raise type(error)(error.errno, os.strerror(error.errno), str(path)) from None  # Arrow's own text is longer
    finally:
        if descriptor is not None:
            os.close(descriptor)
        hidden.unlink(missing_ok=True)


def write_whole(path: Path, data: bytes, replace: bool = True, private: bool = False) -> None:
    """Writes a complete file. See whole_file."""
    with whole_file(path, replace, private) as place, open(place, "wb") as file:
        file.write(data)


def rename_new(file: Path, path: Path) -> None:
    """Renames without overwriting, even if another program creates `path` at the same time.

    Raises FileExistsError.
    """
    try:
        os.link(file, path)
    except FileExistsError:
        raise
    except OSError:  # this file system has no hard links
        if path.exists():
            raise FileExistsError(path) from None
        os.replace(file, path)


def unnamed_file(folder: Path, mode: int) -> int | None:
    """The descriptor of an unnamed file, which is deleted on close. None if the system has no unnamed files."""
    if not hasattr(os, "O_TMPFILE") or not os.path.isdir("/proc/self/fd"):
        return None
    try:
        return os.open(folder, os.O_TMPFILE | os.O_RDWR, mode)
    except OSError as error:
        if error.errno in _NO_UNNAMED:
            return None
        raise


def give_name(descriptor: int, path: Path) -> bool:
    """Gives an unnamed file a name. False if the system cannot. Raises FileExistsError."""
    try:
        # An absolute path does not need src_dir_fd, but only with it does Python follow the link in /proc.
        os.link(f"/proc/self/fd/{descriptor}", path, src_dir_fd=descriptor)
    except FileExistsError:
        raise
    except OSError:
        return False
    return True


def sync(path: Path) -> None:
    """Waits until a file, or the names of the files in a folder, are on the disk.

    Windows and some network file systems cannot wait for names.
    """
    if not (folder := path.is_dir()) or os.name != "nt":
        descriptor = os.open(path, os.O_RDONLY if folder else os.O_RDWR)
        try:
            os.fsync(descriptor)
        except OSError as bad:
            if not folder or bad.errno != errno.EINVAL:
                raise
        finally:
            os.close(descriptor)

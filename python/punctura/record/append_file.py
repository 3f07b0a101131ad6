"""An append-only file that stays valid up to its last complete write."""

import errno
import os
import sys
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from punctura.record.new_file import make_file

_OPEN_FILES = "/proc/self/fd"  # on Linux


class FileChange(NamedTuple):
    """A change that another program made to the file.

    lost: some or all of the written data is gone. place: the file's present path, None if unknown.
    """

    words: str
    lost: bool
    place: Path | None = None


class AppendFile:
    """Creates a new file with its first bytes and locks it. It never overwrites an existing file.

    A failed write can be retried.
    """

    def __init__(self, path: Path, first: bytes = b"") -> None:
        """Raises FileExistsError, OSError."""
        self._path = path
        self.size = 0  # bytes in complete writes
        self._name: int | None = None  # descriptor opened by path; Linux reports the file's present path through it
        # aside: the new path of a damaged file that had this name
        self._descriptor, self.aside = make_file(path, lambda descriptor: self._begin(descriptor, first))
        try:
            self._counts_names = os.fstat(self._descriptor).st_nlink > 0
            if sys.platform == "linux" and os.path.isdir(_OPEN_FILES):
                # self._descriptor was opened before the file had a name, so Linux reports no path for it.
                self._name = os.open(path, os.O_PATH)
        except BaseException:
            self.discard()
            raise

    def _begin(self, descriptor: int, first: bytes) -> None:
        self._descriptor, self.size = descriptor, 0
        self.write(first)

    def write(self, data: bytes) -> None:
        """Appends all bytes or raises OSError. The next write overwrites the remains of a failed one."""
        os.lseek(self._descriptor, self.size, os.SEEK_SET)
        rest = memoryview(data)
        while rest:
            rest = rest[os.write(self._descriptor, rest) :]
        self.size += len(data)

    def change(self) -> FileChange | None:
        """None if the file is still at its path and has its full length; else what has changed."""
        mine = os.fstat(self._descriptor)
        if self._counts_names and mine.st_nlink == 0:
            return FileChange(f"{self._path} was removed or replaced by another program during the recording", True)
        if mine.st_size < self.size:
            return FileChange(f"{self._path} was truncated by another program during the recording", True)
        try:
            if os.path.samestat(mine, os.stat(self._path)):
                return None
        except OSError:
            pass
        place = self.place()
        where = f"recording continues in {place}" if place else "this system does not report the new path"
        return FileChange(f"{self._path} was moved during the recording; {where}", False, place)

    def place(self) -> Path | None:
        """The file's present path, even after a move or rename. None if the system does not report it."""
        places = [self._path]
        if self._name is not None:
            with suppress(OSError):
                places.append(Path(os.readlink(f"{_OPEN_FILES}/{self._name}")))
        for place in places:
            with suppress(OSError):
                if os.path.samestat(os.fstat(self._descriptor), os.stat(place)):
                    return place
        return None

    def source(self) -> Path:
        """A path to read the file from, even if its name is unknown. Raises FileNotFoundError if it was deleted."""
        here = Path(f"{_OPEN_FILES}/{self._descriptor}")
        named = os.fstat(self._descriptor).st_nlink > 0 or not self._counts_names
        place = self.place() or (here if named and here.exists() else None)
        if place is None:
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(self._path))
        return place

    def settle(self) -> None:
        """Truncates the remains of a failed write."""
        if os.fstat(self._descriptor).st_size > self.size:
            os.ftruncate(self._descriptor, self.size)

    def discard(self) -> None:
        """Closes the file and removes it."""
        try:
            if os.name == "posix":  # unlink under the lock: no other recorder can have created a file of this name
                self._path.unlink(missing_ok=True)
        finally:
            self.close()
        if os.name != "posix":  # Windows cannot remove an open file
            self._path.unlink(missing_ok=True)

    def close(self) -> None:
        """Closes the file and releases its lock."""
        if self._descriptor >= 0:
            os.close(self._descriptor)
            if self._name is not None:
                os.close(self._name)
            self._descriptor = -1

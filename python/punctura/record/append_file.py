"""A file that only grows, and is whole up to its last whole write."""

from __future__ import annotations

import errno
import os
import sys
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from punctura.record.new_file import make_file

_OPEN_FILES = "/proc/self/fd"  # on Linux


class Amiss(NamedTuple):
    """What others did to the file.

    lost: what had been written to it is gone, in part or as a whole. place: where the file is now, None if not known.
    """

    words: str
    lost: bool
    place: Path | None = None


class AppendFile:
    """Made anew with its first bytes, and locked; what stands there already is never overwritten.

    A write that fails can be tried again.
    """

    def __init__(self, path: Path, first: bytes = b"") -> None:
        """Raises FileExistsError, OSError."""
        self._path = path
        self.size = 0  # of what was written in whole
        self._name: int | None = None  # opened by its name: through this descriptor Linux tells the present name
        # aside: where a damaged file is now that stood at this path
        self._descriptor, self.aside = make_file(path, lambda descriptor: self._begin(descriptor, first))
        try:
            self._counts_names = os.fstat(self._descriptor).st_nlink > 0
            if sys.platform == "linux" and os.path.isdir(_OPEN_FILES):
                # Not self._descriptor: that was opened before the file had a name, and keeps saying so.
                self._name = os.open(path, os.O_PATH)
        except BaseException:
            self.discard()
            raise

    def _begin(self, descriptor: int, first: bytes) -> None:
        self._descriptor, self.size = descriptor, 0
        self.write(first)

    def write(self, data: bytes) -> None:
        """All of it, or an OSError; what a failed write has left is overwritten by the next."""
        os.lseek(self._descriptor, self.size, os.SEEK_SET)
        rest = memoryview(data)
        while rest:
            rest = rest[os.write(self._descriptor, rest) :]
        self.size += len(data)

    def amiss(self) -> Amiss | None:
        """Whether the file is still the one at its path, and as long as it was written."""
        mine = os.fstat(self._descriptor)
        if self._counts_names and mine.st_nlink == 0:
            return Amiss(f"{self._path} was removed or replaced by another program while it was being recorded", True)
        if mine.st_size < self.size:
            return Amiss(f"{self._path} was cut off by another program while it was being recorded", True)
        try:
            if os.path.samestat(mine, os.stat(self._path)):
                return None
        except OSError:
            pass
        place = self.place()
        where = f"it goes on in {place}" if place else "it goes on under another name; this system does not report it"
        return Amiss(f"{self._path} was moved while it was being recorded; {where}", False, place)

    def place(self) -> Path | None:
        """Where the file is now, also after it was moved or renamed; None where the system does not tell that."""
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
        """Where to read it from, also where its name is not known. Raises FileNotFoundError where it has none."""
        here = Path(f"{_OPEN_FILES}/{self._descriptor}")
        named = os.fstat(self._descriptor).st_nlink > 0 or not self._counts_names
        place = self.place() or (here if named and here.exists() else None)
        if place is None:
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(self._path))
        return place

    def settle(self) -> None:
        """Cuts off what a failed write has left."""
        if os.fstat(self._descriptor).st_size > self.size:
            os.ftruncate(self._descriptor, self.size)

    def discard(self) -> None:
        """Closes the file and removes it."""
        try:
            if os.name == "posix":  # while it is locked: nobody else can have begun a file of this name
                self._path.unlink(missing_ok=True)
        finally:
            self.close()
        if os.name != "posix":  # Windows removes no file that is open
            self._path.unlink(missing_ok=True)

    def close(self) -> None:
        """Releases the lock, too."""
        if self._descriptor >= 0:
            os.close(self._descriptor)
            if self._name is not None:
                os.close(self._name)
            self._descriptor = -1

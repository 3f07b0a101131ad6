"""The folder of recordings. Nothing outside it is read or written."""

import datetime
import os
import re
import shutil
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TypeVar

from punctura.files.names import user_folder
from punctura.files.whole_file import private_folder
from punctura.record import Recording, RecordingError, open_recording
from punctura.record.new_file import in_use, is_abandoned
from punctura.record.recording import read_found
from punctura.studio.names import LONGEST, BadName, safe_name

SUFFIX = ".parquet"
PART = ".part"
LEFT_OVER_S = 3600.0  # after this time nobody still writes a hidden file
T = TypeVar("T")
_UNFINISHED = re.compile(r"\..+\.parquet\.[0-9a-f]{8}\.part")


class Missing(ValueError):
    """There is no such recording."""


class Busy(ValueError):
    """The recording is still being written, or a participant's session has it."""


@dataclass(frozen=True)
class RecordingEntry:
    """One entry of the list of recordings."""

    name: str
    title: str
    started: str  # ISO 8601, UTC
    seconds: float
    ticks: int
    lost: int
    scene: str
    exercise: str  # empty if it is no attempt
    finished: bool


def default_folder() -> Path:
    """The operating system's folder for the user's data of this program."""
    return user_folder("data") / "recordings"


class Shelf:
    """Usable from any thread. Links are not followed: a name is a file of this folder, or nothing."""

    def __init__(self, folder: Path) -> None:
        """The folder is created with the first recording. Hidden files of killed processes are removed."""
        self.folder = folder
        self._sweep()
        self._known: dict[Path, tuple[tuple[int, int], RecordingEntry]] = {}  # by size and time of change

    def _sweep(self) -> None:
        """Removes hidden files of exports and of unnamed recordings, unless somebody may still write them."""
        for path in self.folder.glob(".*") if self.folder.is_dir() else ():
            with suppress(OSError):
                if path.is_symlink() or time.time() - path.stat().st_mtime < LEFT_OVER_S:
                    continue
                if path.is_dir() and path.name.startswith(".export-"):
                    shutil.rmtree(path)
                elif path.is_file() and _UNFINISHED.fullmatch(path.name):
                    path.unlink()

    def new_name(self, wish: str | None, scene: str) -> str:
        """A name for a new recording; by default date and scene. Raises BadName."""
        if wish is not None:
            name = safe_name(wish)
            if self._there(name):
                raise BadName(f"there is a recording {name} already")
            return name
        stem = self._stem(scene)
        name = stem
        for i in range(2, 1000):
            if not self._there(name):
                break
            name = f"{stem} ({i})"
        return name

    def file(self, name: str) -> Path:
        """The file of a new recording. Creates the folder. Raises BadName, OSError."""
        path = self._file(safe_name(name))
        private_folder(self.folder)
        return path

    def find(self, name: str) -> Path:
        """The file of a recording, finished or not. Raises BadName, Missing."""
        path = self._file(safe_name(name))
        # The finished file again: the recording may have been finished after the first look.
        for candidate in (path, path.with_name(path.name + PART), path):
            if candidate.is_file() and not candidate.is_symlink():
                return candidate
        raise Missing(f"there is no recording {name}")

    def has(self, name: str) -> bool:
        """Whether there is such a recording."""
        try:
            return bool(self.find(name))
        except (BadName, Missing):
            return False

    def open(self, name: str) -> Recording:
        """Raises BadName, Missing, RecordingError."""
        return self.read(name, open_recording)

    def read(self, name: str, act: Callable[[Path], T]) -> T:
        """What `act` returns for the file, again if the recording was finished meanwhile: that moves the file.

        Raises BadName, Missing, and what `act` raises.
        """
        return read_found(partial(self.find, name), act)

    def delete(self, name: str, running: str = "") -> None:
        """Raises BadName, Missing, Busy, OSError. running: the name of the recording that this studio makes now.

        A lock shows that another program records it, or that it is being finished.
        """
        path = self.find(name)
        if safe_name(name) == running or in_use(path):
            raise Busy("it is being recorded; stop it first")
        path.unlink()

    def entries(self, exclude: str = "") -> list[RecordingEntry]:
        """All readable recordings, the latest first. exclude: the name of the running one, which is left out."""
        found = []
        for path in sorted(self.folder.iterdir()) if self.folder.is_dir() else ():
            name = path.name.removesuffix(PART).removesuffix(SUFFIX)
            if name == exclude or not path.name.endswith((SUFFIX, SUFFIX + PART)) or name.startswith("."):
                continue
            entry = self._entry(name, path)
            if entry:
                found.append(entry)
        return sorted(found, key=lambda e: (e.started, e.name), reverse=True)

    def _entry(self, name: str, path: Path) -> RecordingEntry | None:
        try:
            if safe_name(name) != name or path.is_symlink() or not path.is_file():
                return None
            stat = path.stat()
            state = (stat.st_size, stat.st_mtime_ns)
            known = self._known.get(path)
            if known is None or known[0] != state:
                known = (state, entry_of(name, open_recording(path)))
                self._known[path] = known
            return known[1]
        except (BadName, RecordingError, OSError):
            return None

    def _there(self, name: str) -> bool:
        path = self._file(name)
        part = path.with_name(path.name + PART)
        return os.path.lexists(path) or (os.path.lexists(part) and not is_abandoned(part))

    def _file(self, name: str) -> Path:
        return self.folder / (name + SUFFIX)

    @staticmethod
    def _stem(scene: str) -> str:
        now = datetime.datetime.now().strftime("%Y-%m-%d %H.%M.%S")
        try:
            return safe_name(f"{now} {scene}"[: LONGEST - 6].strip(" ."))
        except BadName:
            return now


def entry_of(name: str, recording: Recording) -> RecordingEntry:
    """Raises RecordingError."""
    info = recording.info
    about = info.about
    ticks = recording.summary.last_tick - recording.summary.first_tick + 1 if recording.rows else 0
    return RecordingEntry(
        name=name,
        title=str(about.get("title") or name),
        started=info.header.began,
        seconds=max(0, ticks) * info.header.period_s,
        ticks=recording.rows,
        lost=recording.lost,
        scene=info.scene.name,
        exercise=str(about.get("exercise", "")),
        finished=recording.finished,
    )

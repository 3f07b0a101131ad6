"""Which recording is the expert's run of an exercise. A file beside the results keeps it."""

import itertools
import json
import os
import threading
from collections.abc import Callable
from pathlib import Path

from punctura.files.whole_file import private_folder, write_whole

FILE = "experts.json"
LARGEST = 1_000_000  # bytes; an entry has some hundred


class Experts:
    """Usable from any thread. A damaged file is kept under another name and counts as empty."""

    def __init__(self, folder: Path, on_error: Callable[[str], None] = lambda text: None) -> None:
        """folder: of the results, created with the first entry. on_error: gets a sentence about a damaged file."""
        self._on_error = on_error
        self._path = folder.parent / f"{folder.name}-{FILE}"
        self._lock = threading.Lock()

    def all(self) -> dict[str, str]:
        """The name of the recording, by exercise."""
        with self._lock:
            try:
                return self._read()
            except OSError:
                return {}

    def set(self, exercise: str, recording: str) -> None:
        """An empty name of a recording removes the entry. Raises OSError."""
        with self._lock:
            entries = self._read()
            entries.pop(exercise, None)
            if recording:
                entries[exercise] = recording
            private_folder(self._path.parent)
            text = json.dumps(entries, indent=1, ensure_ascii=False)
            write_whole(self._path, text.encode("utf-8"), private=True)

    def _read(self) -> dict[str, str]:
        """The entries; of a damaged file none. Raises OSError."""
        try:
            if self._path.is_symlink():
                raise ValueError("a link")
            if self._path.stat().st_size > LARGEST:
                raise ValueError(f"larger than {LARGEST} bytes")
            entries = json.loads(self._path.read_text(encoding="utf-8"))
            if not isinstance(entries, dict) or not all(isinstance(name, str) for name in entries.values()):
                raise ValueError("not a table of names")
        except FileNotFoundError:
            return {}
        except (ValueError, RecursionError) as bad:
            self._put_aside(bad)
            return {}
        return entries

    def _put_aside(self, bad: Exception) -> None:
        kept = (self._path.with_name(f"{self._path.stem}-damaged-{k}.json") for k in itertools.count(1))
        free = next(path for path in kept if not os.path.lexists(path))
        self._path.rename(free)
        self._on_error(
            f"The list of experts' runs {self._path} is damaged ({bad}). It is kept as {free.name}, and the list is "
            "empty now. Choose the experts' runs again, or mend the file and rename it."
        )

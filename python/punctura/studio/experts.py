"""Which recording is the expert's run of an exercise. A file beside the results keeps it."""

from __future__ import annotations

import json
import threading
from pathlib import Path

from punctura.files.whole_file import write_whole

FILE = "experts.json"
LARGEST = 1_000_000  # bytes; an entry has some hundred


class Experts:
    """Usable from any thread. A file that cannot be read counts as empty, and the next change replaces it."""

    def __init__(self, folder: Path) -> None:
        """folder: of the results. It is created with the first entry."""
        self._path = folder.parent / f"{folder.name}-{FILE}"
        self._lock = threading.Lock()

    def all(self) -> dict[str, str]:
        """The name of the recording, by exercise."""
        try:
            if self._path.is_symlink() or self._path.stat().st_size > LARGEST:
                return {}
            entries = json.loads(self._path.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}
        if not isinstance(entries, dict):
            return {}
        return {str(exercise): name for exercise, name in entries.items() if isinstance(name, str)}

    def set(self, exercise: str, recording: str) -> None:
        """An empty name of a recording removes the entry. Raises OSError."""
        with self._lock:
            entries = self.all()
            entries.pop(exercise, None)
            if recording:
                entries[exercise] = recording
            self._path.parent.mkdir(0o700, parents=True, exist_ok=True)
            write_whole(self._path, json.dumps(entries, indent=1, ensure_ascii=False).encode("utf-8"), replace=True)

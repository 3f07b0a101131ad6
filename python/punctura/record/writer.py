"""The thread that appends to the file. It alone waits for the disk."""

from __future__ import annotations

import os
import threading
import time
from pathlib import Path

from punctura.record.append_file import AppendFile
from punctura.record.backlog import Backlog

RETRY_S = 0.5
LAST_TRIES_S = 2.0  # for a disk that fails when the recording is to be finished
_MOST_NOTES = 100


class Writer:
    """Takes pieces from the backlog. A write that fails is told, and tried again until the recording ends."""

    def __init__(self, file: AppendFile, backlog: Backlog, path: Path) -> None:
        self._file, self._backlog, self._path = file, backlog, path
        self.rows = 0
        self.last_tick = -1
        self.slowest_s = 0.0
        self.trouble = ""
        self.notes: list[str] = []
        self._trouble_began = 0.0
        self._thread = threading.Thread(target=self._run, name="punctura-recorder-writer", daemon=True)
        self._thread.start()

    @property
    def size(self) -> int:
        return self._file.size

    def join(self) -> None:
        """After the backlog is closed: waits until all is written, or cannot be."""
        self._thread.join()

    def note(self, text: str) -> None:
        if len(self.notes) < _MOST_NOTES:
            self.notes.append(text)

    def _run(self) -> None:
        give_up: float | None = None
        while (piece := self._backlog.first()) is not None:
            began = time.monotonic()
            try:
                self._file.write(piece.data)
            except OSError as bad:
                self._fail(bad, began)
                if self._backlog.closing:
                    give_up = give_up or began + LAST_TRIES_S
                    if began >= give_up:
                        return
                    time.sleep(RETRY_S)
                else:
                    self._backlog.pause(RETRY_S)
                continue
            now, give_up = time.monotonic(), None
            self.slowest_s = max(self.slowest_s, now - began)
            self._backlog.done()
            self.rows += piece.rows
            self.last_tick = piece.last_tick if piece.rows else self.last_tick
            if self.trouble:
                self.note(f"{self.trouble}; it could again after {now - self._trouble_began:.1f} s")
                self.trouble = ""

    def _fail(self, bad: OSError, now: float) -> None:
        if not self.trouble:
            self._trouble_began = now
        reason = os.strerror(bad.errno) if bad.errno else str(bad)
        self.trouble = f"{self._path} could not be written: {reason}"

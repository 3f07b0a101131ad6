"""The writer thread, and the queue of what it has to write. Only this thread waits for the disk."""

import os
import threading
import time
from collections import deque
from pathlib import Path
from typing import NamedTuple

from punctura.defects import explain
from punctura.errors import FREE_SPACE, is_full
from punctura.record.append_file import AppendFile
from punctura.record.description import RecordingError
from punctura.record.part_file import PartFile


class Piece(NamedTuple):
    """Bytes to append, with the number of ticks in them."""

    data: bytes
    rows: int
    last_tick: int


class Backlog:
    """Connects the thread that reads a loop's ring with the one that writes, so a slow disk does not fill the ring."""

    def __init__(self, limit_bytes: int) -> None:
        self._limit = limit_bytes
        self._pieces: deque[Piece] = deque()
        self._bytes = 0
        self._closing = False
        self._changed = threading.Condition()

    @property
    def waiting_bytes(self) -> int:
        return self._bytes

    def put(self, piece: Piece) -> bool:
        """Returns False if these ticks do not fit. A piece without ticks (the start of a stream) always fits."""
        with self._changed:
            if piece.rows and self._bytes + len(piece.data) > self._limit:
                return False
            self._pieces.append(piece)
            self._bytes += len(piece.data)
            self._changed.notify_all()
            return True

    def close(self) -> None:
        """Ends the input: no more pieces follow."""
        with self._changed:
            self._closing = True
            self._changed.notify_all()

    @property
    def closing(self) -> bool:
        return self._closing

    def first(self) -> Piece | None:
        """Waits for the oldest piece and returns it without removing it. None once the queue is closed and empty."""
        with self._changed:
            while not self._pieces and not self._closing:
                self._changed.wait()
            return self._pieces[0] if self._pieces else None

    def done(self) -> None:
        """Removes the oldest piece after it was written."""
        with self._changed:
            self._bytes -= len(self._pieces.popleft().data)

    def pause(self, seconds: float) -> None:
        """Waits for `seconds` or until close(), whichever comes first."""
        with self._changed:
            self._changed.wait_for(lambda: self._closing, seconds)

    def rows(self) -> int:
        """Number of ticks in the queue."""
        with self._changed:
            return sum(piece.rows for piece in self._pieces)


RETRY_S = 0.5
LAST_TRIES_S = 2.0  # retry this long if the disk fails at the end of the recording
_MOST_NOTES = 100
_ADVICE = f"; {FREE_SPACE}, and writing goes on"  # while the recording goes on


class Writer:
    """Writes pieces from the backlog. Reports a failed write and retries it until the recording ends.

    Before each write it checks that the file is still at its path and complete.
    """

    def __init__(self, file: AppendFile, backlog: Backlog, path: Path) -> None:
        self._file, self._backlog, self._path = file, backlog, path
        self.place: Path | None = path  # see AppendFile.place
        self.rows = 0
        self.last_tick = -1
        self.ruined = 0  # ticks that were written and are now gone
        self.slowest_s = 0.0
        self.trouble = ""
        self.why_unwritten = ""  # reason of the last write error; empty while writing works
        self.notes: list[str] = []
        self._trouble_began = 0.0
        self._lost = False  # the written data is gone; writing has ended
        self._thread = threading.Thread(target=self._run, name="punctura-recorder-writer", daemon=True)
        self._thread.start()

    @property
    def size(self) -> int:
        return self._file.size

    def join(self) -> None:
        """Call after the backlog is closed. Waits until all pieces are written or have failed."""
        self._thread.join()
        self.trouble = self.trouble.removesuffix(_ADVICE)

    def note(self, text: str) -> None:
        if len(self.notes) < _MOST_NOTES:
            self.notes.append(text)

    def _run(self) -> None:
        give_up: float | None = None
        while (piece := self._backlog.first()) is not None:
            began = time.monotonic()
            try:
                moved = self._check()
                self._file.write(piece.data)
            except Exception as bad:  # report any error, then try the next piece
                self._fail(bad, began)
                if self._backlog.closing:
                    give_up = give_up or began + LAST_TRIES_S
                    if began >= give_up or self._lost:
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
            self._report(moved, now)

    def _check(self) -> str:
        """A message if the file was moved, else empty. Raises _Lost if it was deleted or truncated."""
        change = self._file.change()
        if change is None:
            self.place = self._path
            return ""
        if not change.lost:
            self.place = change.place
            return change.words
        if not self._lost:
            self._lost = True
            before = self.rows
            self.rows, self.last_tick = self._readable()
            self.ruined = max(0, before - self.rows)
        raise _Lost(change.words)

    def _readable(self) -> tuple[int, int]:
        """Number of readable ticks and the last tick; (0, -1) if none."""
        try:
            survey = PartFile(self._file.source()).survey
        except (RecordingError, OSError):
            return 0, -1
        return survey.rows, survey.last_tick

    def _report(self, moved: str, now: float) -> None:
        """After a write: reports that the file was moved, or notes that a problem has ended."""
        self.why_unwritten = ""
        if moved:
            self._trouble_began = self._trouble_began if self.trouble else now
            self.trouble = moved
        elif self.trouble:
            self.note(f"{self.trouble}; resolved after {now - self._trouble_began:.1f} s")
            self.trouble = ""

    def _fail(self, bad: Exception, now: float) -> None:
        if not self.trouble:
            self._trouble_began = now
        if isinstance(bad, _Lost):
            self.trouble = self.why_unwritten = str(bad)
            return
        reason = os.strerror(bad.errno) if isinstance(bad, OSError) and bad.errno else explain(bad)
        advice = _ADVICE * is_full(bad)
        self.trouble, self.why_unwritten = f"{self._path} could not be written: {reason}{advice}", reason


class _Lost(Exception):
    """The written data is gone."""

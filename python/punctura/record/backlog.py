"""A queue of data that waits for the disk, in bounded memory."""

from __future__ import annotations

import threading
from collections import deque
from typing import NamedTuple


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

"""What waits for the disk, in bounded memory."""

from __future__ import annotations

import threading
from collections import deque
from typing import NamedTuple


class Piece(NamedTuple):
    """Bytes to append, and how many ticks they hold."""

    data: bytes
    rows: int
    last_tick: int


class Backlog:
    """Between the thread that reads a loop's ring and the one that writes: a slow disk does not fill the ring."""

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
        """False: there is no room for these ticks. What holds none, the beginning of a stream, always finds room."""
        with self._changed:
            if piece.rows and self._bytes + len(piece.data) > self._limit:
                return False
            self._pieces.append(piece)
            self._bytes += len(piece.data)
            self._changed.notify_all()
            return True

    def close(self) -> None:
        """Nothing comes any more."""
        with self._changed:
            self._closing = True
            self._changed.notify_all()

    @property
    def closing(self) -> bool:
        return self._closing

    def first(self) -> Piece | None:
        """Waits for the oldest piece and leaves it where it is; None when there is nothing and nothing will come."""
        with self._changed:
            while not self._pieces and not self._closing:
                self._changed.wait()
            return self._pieces[0] if self._pieces else None

    def done(self) -> None:
        """The oldest piece is on the disk."""
        with self._changed:
            self._bytes -= len(self._pieces.popleft().data)

    def pause(self, seconds: float) -> None:
        """Waits, but not for longer than until close()."""
        with self._changed:
            self._changed.wait_for(lambda: self._closing, seconds)

    def rows(self) -> int:
        """Ticks that wait."""
        with self._changed:
            return sum(piece.rows for piece in self._pieces)

"""How much anyone may send: sizes and rates. A page stays far below them all."""

from __future__ import annotations

import time
from collections.abc import Callable

MOST_BODY = 64_000  # bytes of an HTTP request
MOST_TEXT = 64_000  # bytes of a request on the socket
MOST_SCENE_TEXT = 256_000  # bytes of the one that carries a scene file, of 200 000 characters at most
REQUESTS_A_SECOND, REQUESTS_AT_ONCE = 400, 1200  # of one page: targets at 240 frames a second, and the rest
HTTP_A_SECOND, HTTP_AT_ONCE = 200, 600  # of all


class Bucket:
    """So many at once, then so many a second."""

    def __init__(self, rate: float, most: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._rate, self._most, self._clock = rate, most, clock
        self._left, self._at = most, clock()

    def take(self) -> bool:
        """False: too many."""
        now = self._clock()
        self._left = min(self._most, self._left + (now - self._at) * self._rate)
        self._at = now
        if self._left < 1:
            return False
        self._left -= 1
        return True

    def empty(self) -> None:
        """As if all had been taken."""
        self._left, self._at = 0.0, self._clock()

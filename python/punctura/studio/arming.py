"""Whether a run may give force: a pause, from any thread, wins over every request that was made before it."""

from __future__ import annotations

import threading
from collections.abc import Callable

from punctura._core import ServoLoop


class Arming:
    """`pause` from any thread; everything else from the worker's."""

    def __init__(self) -> None:
        self.armed = False
        self.pauses = 0  # how many were asked for so far
        self._asked_at = 0  # the value of `pauses` when the request came that the worker does now
        self._lock = threading.Lock()  # held only for a moment, because `pause` waits for it

    def pause(self, loop: Callable[[], ServoLoop]) -> None:
        """Takes the force away at once. loop: returns the present loop."""
        with self._lock:
            self.pauses += 1
            loop().pause()
            self.armed = False

    def asked_at(self, pauses: int) -> None:
        """The worker begins a request that came after so many pauses."""
        self._asked_at = pauses

    def arm(self, loop: ServoLoop) -> None:
        """Allows force once the tip is outside tissue, unless a pause came after the request that the worker does."""
        with self._lock:
            self.armed = self._asked_at == self.pauses
            if self.armed:
                loop.arm()

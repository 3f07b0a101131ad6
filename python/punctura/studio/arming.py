"""Whether a run may give force.

The first run is armed by itself. After "Turn force off", a fault, or ticks that ceased, only a person turns the force
on again: no new run, scene or exercise does. "Turn force off" works from any thread, and wins over every request that
was made before it.
"""

import threading
from collections.abc import Callable

from punctura._core import ServoLoop


class Arming:
    """`pause` and `withhold` from any thread; everything else from the worker's."""

    def __init__(self) -> None:
        self.armed = False
        self.pauses = 0  # how many were asked for so far
        self._withheld = False  # until a person turns the force on
        self._asked_at = 0  # the value of `pauses` when the request came that the worker does now
        self._lock = threading.Lock()  # held only for a moment, because `pause` waits for it

    def pause(self, loop: Callable[[], ServoLoop]) -> None:
        """Takes the force away at once. loop: returns the present loop."""
        with self._lock:
            self.pauses += 1
            self._withheld = True
            loop().pause()
            self.armed = False

    def withhold(self) -> None:
        """No run gives force until a person turns it on: after a fault, ceased ticks, or a failed start."""
        with self._lock:
            self._withheld = True
            self.armed = False

    def asked_at(self, pauses: int) -> None:
        """The worker begins a request that came after so many pauses."""
        self._asked_at = pauses

    def begin(self, loop: ServoLoop) -> None:
        """A run begins: it may give force once the tip is outside tissue, unless force is withheld."""
        with self._lock:
            self.armed = not self._withheld
            if self.armed:
                loop.arm()

    def turn_on(self, loop: ServoLoop) -> None:
        """A person allows force once the tip is outside tissue. Does nothing if a pause came after this request."""
        with self._lock:
            if self._asked_at == self.pauses:
                self._withheld = False
                self.armed = True
                loop.arm()

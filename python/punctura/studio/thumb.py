"""The simulated thumb on the plunger of a scene's syringe. Only the worker calls it."""

from __future__ import annotations

import math

from punctura._core import ServoLoop

HOLD_S = 1.0  # a page that still pushes says so more often


class SimulatedThumb:
    """Pushes with the force that the page last asked for, and lets go if the page falls silent."""

    def __init__(self) -> None:
        self._until = math.inf

    def push(self, loop: ServoLoop, force: float, now: float) -> None:
        """force: N, 0 to 15. now: s, on the clock of `turn`."""
        loop.push_plunger(force)
        self._until = now + HOLD_S if force > 0 else math.inf

    def turn(self, loop: ServoLoop, now: float) -> None:
        if now >= self._until:
            self.push(loop, 0.0, now)

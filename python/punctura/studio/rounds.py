"""When to play a recorded motion again."""

from __future__ import annotations

import math

from punctura._core import Device, ReplayDevice

REST_S = 2.0  # between two rounds


class Rounds:
    """A device that plays a recorded motion plays it again after a rest."""

    def __init__(self) -> None:
        self._over_at = math.inf

    def due(self, device: Device, recording: bool, now: float) -> bool:
        """Whether the next round must begin. recording: a run that is recorded is not repeated."""
        over = isinstance(device, ReplayDevice) and device.finished and not recording
        self._over_at = min(self._over_at, now) if over else math.inf
        if now - self._over_at < REST_S:
            return False
        self._over_at = math.inf
        return True

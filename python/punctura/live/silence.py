"""A device whose ticks have ceased keeps its last force, and no tick can tell: somebody else has to watch."""

from __future__ import annotations

import time

from punctura._core import FedDevice, ReplayDevice, ServoLoop, SimulatedDevice

LONGEST_S = 0.1  # without a tick; a later deadline of the gate's makes it longer
# A simulated or recorded motion may end, and whoever feeds a device knows when it does: nobody's hand is held.
HELD_BY_NOBODY: tuple[type, ...] = (SimulatedDevice, ReplayDevice, FedDevice)


class SilenceWatch:
    """Of one run, asked a few times a second by a thread that may stop the loop.

    It does not ask the driver what is wrong: that may take time, and the stop must not wait for it.
    """

    def __init__(self, loop: ServoLoop) -> None:
        self._loop = loop
        self._of_hardware = not isinstance(loop.device, HELD_BY_NOBODY)
        self._longest = max(LONGEST_S, 5 * loop.gate.deadline)
        self._ticks, self._since = -1, time.monotonic()

    def __repr__(self) -> str:
        return f"<SilenceWatch of {self._loop}>"

    def ceased(self) -> str:
        """Why the loop must be stopped, in words; empty while ticks come."""
        if not self._of_hardware:
            return ""
        now, ticks = time.monotonic(), self._loop.report()["ticks"]
        if ticks != self._ticks:
            self._ticks, self._since = ticks, now
            return ""
        if now - self._since < self._longest:
            return ""
        return (
            f"the device's ticks have ceased, for {now - self._since:.1f} s, and the run is stopped: "
            "should the device still pull, switch it off"
        )

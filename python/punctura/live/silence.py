"""Detects that a device's ticks have ceased. The device keeps its last force then, so another thread must watch."""

from __future__ import annotations

import time
from collections.abc import Callable

from punctura._core import Device, FedDevice, ReplayDevice, ServoLoop, SimulatedDevice, ThumbLoop
from punctura.live.choose import gate_for

LONGEST_S = 0.1  # without a tick; a longer deadline of the gate extends it
# These devices may stop ticking without danger: nobody holds them.
HELD_BY_NOBODY: tuple[type, ...] = (SimulatedDevice, ReplayDevice)
FED_S = 1.0  # for a device that a program feeds: the program may be held up
FIRST_READING_S = 30.0  # that such a program may take before its first reading


class SilenceWatch:
    """Watches one run, and the second device of it. A thread that can stop the loop calls it a few times a second.

    It does not ask the driver what is wrong: the answer may take time, and the stop must not wait.
    """

    def __init__(self, loop: ServoLoop, thumb: ThumbLoop | None = None) -> None:
        """thumb: the second device's loop, if the run has one."""
        self._loop = loop
        self._watched = [_Ticks("the device's", loop.device, loop.gate.deadline, lambda: loop.report()["ticks"])]
        if thumb is not None:
            deadline = gate_for(thumb.device).deadline  # a longer one that the user chose does not count here
            self._watched.append(_Ticks("the second device's", thumb.device, deadline, lambda: thumb.ticks))

    def __repr__(self) -> str:
        return f"<SilenceWatch of {self._loop}>"

    def ceased(self) -> str:
        """Why the loop must be stopped, in words; empty while ticks come."""
        return next(filter(None, [one.ceased() for one in self._watched]), "")


class _Ticks:
    """The ticks of one device."""

    def __init__(self, whose: str, device: Device, deadline: float, count: Callable[[], int]) -> None:
        """deadline: of the input gate, s."""
        self._whose, self._count = whose, count
        self._of_hardware = not isinstance(device, HELD_BY_NOBODY)
        self._fed = isinstance(device, FedDevice)
        self._longest = max(FED_S if self._fed else LONGEST_S, 5 * deadline)
        self._ticks, self._since = -1, time.monotonic()

    def ceased(self) -> str:
        if not self._of_hardware:
            return ""
        now, ticks = time.monotonic(), self._count()
        if ticks != self._ticks:
            self._ticks, self._since = ticks, now
            return ""
        if now - self._since < (FIRST_READING_S if self._fed and ticks == 0 else self._longest):
            return ""
        return (
            f"{self._whose} ticks have ceased, for {now - self._since:.1f} s, and the run is stopped: "
            "should the device still pull, switch it off"
        )

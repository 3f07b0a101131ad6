"""Reads the pose of a device."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from punctura._core import DeviceError, ServoLoop

Vector = npt.NDArray[np.float64]
POLL_S = 0.01


def present_pose(
    loop: ServoLoop, wait: float = 5.0, sleep: Callable[[float], None] = time.sleep
) -> tuple[Vector, Vector]:
    """Position (m) and axis in the last tick of a started loop. wait: the longest time to the first tick, s.

    Raises DeviceError if no tick came in this time, or if the position is not finite.
    """
    for _ in range(max(1, round(wait / POLL_S))):
        if loop.report()["ticks"]:
            break
        sleep(POLL_S)
    else:
        raise DeviceError(f"the device has not said in {wait:g} s where it is; {loop.device.trouble() or 'no reason'}")
    last = loop.latest()
    position, axis = last["position"][0], last["axis"][0]
    points = np.isfinite(axis).all() and (axis.any() or not loop.device.info.has_orientation)
    if not (np.isfinite(position).all() and points):
        raise DeviceError(f"the device says that it is at {position}, pointing along {axis}: no place at all")
    return position, axis

"""Converts the rate of a motion to the servo rate."""

from __future__ import annotations

from punctura.simulation.even import DRIFT, TOLERANCE, Evenness
from punctura.simulation.motion_error import MotionError
from punctura.simulation.resample import Resampler

SLOWEST_STEP = 0.1  # s between rows; with larger steps the resampled motion would be mostly invented
FASTEST_STEP = 1e-7  # s


def resampler_for(even: Evenness, rate: float) -> Resampler | None:
    """The resampler, or None if the motion is at the servo rate and each row is one tick. Raises MotionError."""
    period = 1 / rate
    if even.step is None:
        return None
    if even.step > SLOWEST_STEP * (1 + DRIFT):
        raise MotionError(
            even.file,
            0,
            f"time_s grows by {even.step:.6g} s from row to row, and a motion must have {1 / SLOWEST_STEP:g} rows a "
            "second or more; where time_s is in another unit, write seconds, else sample the motion more often "
            "(numpy.interp does it)",
        )
    if even.step < FASTEST_STEP:
        raise MotionError(
            even.file,
            0,
            f"time_s grows by {even.step:.6g} s from row to row, and a motion must have {1 / FASTEST_STEP:g} rows a "
            "second at most; where time_s is in another unit, write seconds",
        )
    if abs(even.step - period) * (even.count - 1) <= TOLERANCE * period:
        return None
    return Resampler(even.first, even.step, period, even.count)

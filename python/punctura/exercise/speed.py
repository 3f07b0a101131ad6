"""Measures the mean velocity of the tip in the tissue."""

from __future__ import annotations

import numpy as np

from punctura.exercise.ticks import Flags, JudgedTicks, Numbers

_TICK_S = 1e-9  # rounding of times

PAUSE_SPEED = 0.5e-3  # m/s; a slower needle stands still


class MeanSpeed:
    """Takes the ticks of an attempt, in batches of any size."""

    def __init__(self, seconds: float) -> None:
        """seconds: of the mean."""
        self._seconds = seconds
        self._time, self._tip, self._inside = np.zeros(0), np.zeros((0, 3)), np.zeros(0, np.bool_)

    def add(self, ticks: JudgedTicks) -> tuple[Numbers, Flags]:
        """The mean velocity up to each tick, (n, 3), m/s, and whether it is known: the needle was in the tissue for all
        of the time, and all positions are numbers. Else 0."""
        good = ticks.inside.any(axis=1) & np.isfinite(ticks.tip).all(axis=1)
        time = np.concatenate([self._time, ticks.time])
        tip = np.concatenate([self._tip, ticks.tip])
        inside = np.concatenate([self._inside, good])
        rows = np.arange(len(self._time), len(time))
        start = np.searchsorted(time, time[rows] - self._seconds + _TICK_S, side="right") - 1
        outside = np.concatenate([[0], np.cumsum(~inside)])
        first = np.maximum(start, 0)
        known: Flags = (start >= 0) & (outside[rows + 1] == outside[first])
        span = np.where(known, time[rows] - time[first], 1.0)
        moved = np.where(known[:, None], tip[rows] - tip[first], 0.0) / span[:, None]
        keep = max(0, int(start[-1]))
        self._time, self._tip, self._inside = time[keep:], tip[keep:], inside[keep:]
        return moved, known

"""Turning points of a noisy curve, and from them the strokes of the needle."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def noise_of(values: Array) -> float:
    """Standard deviation of the noise from sample to sample, in the unit of values. Slow changes do not count."""
    if len(values) < 4:
        return 0.0
    second = values[2:] - 2 * values[1:-1] + values[:-2]
    return float(1.4826 * np.median(np.abs(second)) / np.sqrt(6))


def turning_points(values: Array, hysteresis: float) -> list[int]:
    """Indices of the extremes of a curve, alternately high and low, with the first and the last sample.

    A turn counts only if the curve then moves by more than `hysteresis`, in the unit of values.
    """
    points, direction, best = [0], 0, 0
    series = values.tolist()
    low = high = 0
    for i, value in enumerate(series):
        if direction == 0:  # not known yet
            low, high = (i if value < series[low] else low), (i if value > series[high] else high)
            if series[high] - series[low] > hysteresis:
                direction = 1 if high > low else -1
                best = high if direction > 0 else low
                start = low if direction > 0 else high
                if start > 0:
                    points.append(start)
        elif (value - series[best]) * direction >= 0:
            best = i
        elif (series[best] - value) * direction > hysteresis:
            points.append(best)
            direction, best = -direction, i
    if direction != 0 and best not in (0, points[-1]):
        points.append(best)
    if points[-1] != len(series) - 1:
        points.append(len(series) - 1)
    return points


def depth_hysteresis(depth: Array) -> float:
    """The smallest reversal of the needle that counts as one, m: 2 % of the range, and six times the noise."""
    return max(0.02 * float(np.ptp(depth)), 6 * noise_of(depth))


def insertion_numbers(depth: Array, hysteresis: float) -> NDArray[np.int64]:
    """The number of the insertion for each sample (n,). A new insertion begins where the needle turns inwards again."""
    numbers = np.zeros(len(depth), np.int64)
    points = turning_points(depth, hysteresis)
    seen_out = False
    for start, end in pairwise(points):
        rise = depth[end] - depth[start]
        if rise < -hysteresis:
            seen_out = True
        elif rise > hysteresis and seen_out:
            numbers[start:] += 1
            seen_out = False
    return numbers

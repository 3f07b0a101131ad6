"""Linear interpolation of an evenly sampled motion at another rate, block by block."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ROWS_AT_ONCE = 1 << 14  # what is computed together, however much the rate goes up


class Resampler:
    """Turns rows every `step` seconds into rows every `period` seconds, from `start` to the last row."""

    def __init__(self, start: float, step: float, period: float, rows: int) -> None:
        self._start, self._period, self._ratio = start, period, period / step
        self._rows = self._rows_within(rows)  # all there will be
        self._taken = 0  # rows taken in
        self._given = 0  # rows given out
        self._last: Array | None = None  # the row before the block

    def _rows_within(self, rows: int) -> int:
        """How many new rows lie within so many old ones. A rounding error must not lose the last one."""
        return math.floor((rows - 1) / self._ratio + 1e-6) + 1

    def add(self, rows: Array) -> Iterator[tuple[Array, Array]]:
        """(time, values) of the new rows up to the last one taken in, a limited number at once."""
        start = self._taken
        if self._last is not None:
            rows, start = np.concatenate((self._last[None], rows)), start - 1
        self._taken = start + len(rows)
        self._last = rows[-1].copy()

        end = min(self._rows_within(self._taken), self._rows)
        while self._given < end:
            index = np.arange(self._given, min(self._given + ROWS_AT_ONCE, end))
            self._given += len(index)
            place = np.clip(index * self._ratio - start, 0, len(rows) - 1)  # in rows of this block
            below = np.minimum(place.astype(np.int64), max(len(rows) - 2, 0))
            above = np.minimum(below + 1, len(rows) - 1)
            weight = (place - below)[:, None]
            values = np.asarray((1 - weight) * rows[below] + weight * rows[above], dtype=np.float64)
            time = np.asarray(self._start + index * self._period, dtype=np.float64)
            yield time, values


def with_axis(position: Array, axis: Array) -> Array:
    """Position and direction side by side, to be interpolated together."""
    return np.concatenate((position, unit(axis)), axis=1)


def unit(axis: Array) -> Array:
    """Directions of length 1. Scaled first: the square of a tiny or huge component is no number."""
    scaled: Array = axis / np.abs(axis).max(axis=1, keepdims=True)
    length: Array = np.linalg.norm(scaled, axis=1, keepdims=True)
    return scaled / length

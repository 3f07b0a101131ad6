"""Resamples an evenly sampled motion at another rate by linear interpolation, block by block."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ROWS_AT_ONCE = 1 << 14  # rows computed at once, for any increase of the rate


class Resampler:
    """Resamples from one row every `step` seconds to one every `period` seconds, from `start` to the last row."""

    def __init__(self, start: float, step: float, period: float, rows: int) -> None:
        self._start, self._period, self._ratio = start, period, period / step
        self._rows = self._rows_within(rows)  # total number of output rows
        self._taken = 0  # input rows so far
        self._given = 0  # output rows so far
        self._last: Array | None = None  # last row of the previous block

    def _rows_within(self, rows: int) -> int:
        """Number of output rows within `rows` input rows. A rounding error must not lose the last one."""
        return math.floor((rows - 1) / self._ratio + 1e-6) + 1

    def add(self, rows: Array) -> Iterator[tuple[Array, Array]]:
        """Yields (time, values) of the output rows up to the last input row, ROWS_AT_ONCE at a time."""
        start = self._taken
        if self._last is not None:
            rows, start = np.concatenate((self._last[None], rows)), start - 1
        self._taken = start + len(rows)
        self._last = rows[-1].copy()

        end = min(self._rows_within(self._taken), self._rows)
        while self._given < end:
            index = np.arange(self._given, min(self._given + ROWS_AT_ONCE, end))
            self._given += len(index)
            place = np.clip(index * self._ratio - start, 0, len(rows) - 1)  # position in rows of this block
            below = np.minimum(place.astype(np.int64), max(len(rows) - 2, 0))
            above = np.minimum(below + 1, len(rows) - 1)
            weight = (place - below)[:, None]
            values = np.asarray((1 - weight) * rows[below] + weight * rows[above], dtype=np.float64)
            time = np.asarray(self._start + index * self._period, dtype=np.float64)
            yield time, values


def with_axis(position: Array, axis: Array) -> Array:
    """Position and direction in one array, for joint interpolation."""
    return np.concatenate((position, unit(axis)), axis=1)


def unit(axis: Array) -> Array:
    """Normalizes directions. Scales first, because the square of a tiny or huge component under- or overflows."""
    scaled: Array = axis / np.abs(axis).max(axis=1, keepdims=True)
    length: Array = np.linalg.norm(scaled, axis=1, keepdims=True)
    return scaled / length

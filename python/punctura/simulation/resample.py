"""Brings a motion to an even rate."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from punctura.simulation.columns import MotionError

Array = NDArray[np.float64]

SLOWEST_STEP = 0.1  # s between rows; with larger steps the resampled motion would be mostly invented
FASTEST_STEP = 1e-7  # s
TOLERANCE = 0.25  # of a step
DRIFT = 1e-3  # of the rate
_ADVICE = "resample the motion evenly first (numpy.interp does it)"
ROWS_AT_ONCE = 1 << 14  # rows computed at once, for any increase of the rate


class Evenness:
    """Checks time stamps block by block, and determines their number and step.

    Time stamps are often rounded (0.0006, 0.0013, 0.0019 for 1600 Hz), so comparing neighbours is not enough. A motion
    is even if, within each block, each stamp is within a quarter of a step of an even grid, and if the step of each
    block differs from that of the first by less than 0.1 %, apart from the error of its two ends. A quarter of a step
    accepts four decimals at 1600 Hz (an error of at most 0.16 steps) and rejects a missing sample (an error of a whole
    step).
    """

    def __init__(self, file: Path) -> None:
        self.file = file
        self.count = 0
        self.first = self.last = 0.0
        self._step: float | None = None  # step of the first block
        self._gap: MotionError | None = None  # a gap; not an error if a later row lies in it

    @property
    def step(self) -> float | None:
        """Mean step, s; None for a single sample."""
        return (self.last - self.first) / (self.count - 1) if self.count > 1 else None

    def add(self, first_line: int, time: Array) -> None:
        """Checks a block. Raises MotionError with the first line that is not even."""
        if self.count:
            time, first_line = np.concatenate(([self.last], time)), first_line - 1
        else:
            self.first = float(time[0])
        self.count += len(time) - (1 if self.count else 0)
        self.last = float(time[-1])
        if self._gap:
            self._raise_gap(first_line, time)
        if len(time) > 1:
            self._check(first_line, time)

    def finish(self) -> None:
        """Call after the last block. Raises MotionError for a gap near the end."""
        if self._gap:
            raise self._gap

    def _check(self, first_line: int, time: Array) -> None:
        steps = np.diff(time)
        usual = float(np.median(steps)) if self._step is None else self._step
        if usual <= 0:  # most stamps repeat: report the first one
            usual = float(np.max(steps)) if np.max(steps) > 0 else 1.0
        bad = np.flatnonzero(~((steps > usual / 2) & (steps < 1.5 * usual)))
        if len(bad):
            i = int(bad[0]) + 1
            error = MotionError(self.file, first_line + i, _step_problem(float(time[i - 1]), float(time[i]), usual))
            if steps[i - 1] <= usual:
                raise error
            self._gap = error
            self._raise_gap(first_line + i, time[i:], wait=True)
            return
        index = np.arange(len(time))
        mean = float(time[-1] - time[0]) / (len(time) - 1)
        off = np.abs(time - (time[0] + index * mean))
        worst = int(np.argmax(off))
        if off[worst] > TOLERANCE * usual:
            raise MotionError(
                self.file,
                first_line + worst,
                f"time_s is uneven here: {time[worst]:.9g} s is {off[worst] / mean:.2g} steps off a regular grid of "
                f"{mean:.6g} s; {_ADVICE}",
            )
        if self._step is None:
            self._step = mean
        elif abs(mean - self._step) * (len(time) - 1) > self._step * (2 * TOLERANCE + DRIFT * (len(time) - 1)):
            raise MotionError(
                self.file,
                first_line,
                f"time_s changes its step from {self._step:.6g} s to {mean:.6g} s here; {_ADVICE}",
            )

    def _raise_gap(self, first_line: int, time: Array, wait: bool = False) -> None:
        """Raises the gap. If time goes back later, raises that instead: rows are out of order, and none is missing.

        wait: do not raise the gap before the next block was checked.
        """
        back = np.flatnonzero(np.diff(time) < 0)
        if len(back):
            i = int(back[0]) + 1
            raise MotionError(self.file, first_line + i, _step_problem(float(time[i - 1]), float(time[i]), 1.0))
        if self._gap and not wait:
            raise self._gap


def _step_problem(before: float, now: float, usual: float) -> str:
    step = now - before
    if step < 0:
        return f"time_s goes back, from {before:.9g} s to {now:.9g} s; sort the rows, or cut the motion there"
    if step == 0:
        return f"time_s stays at {now:.9g} s; write the time with more digits, or remove the repeated sample"
    missing = round(step / usual) - 1
    if missing >= 1 and abs(step / usual - missing - 1) < TOLERANCE:
        samples = f"{missing} sample{'s' if missing != 1 else ''} missing"
        return (
            f"a gap from {before:.9g} s to {now:.9g} s ({samples} at {usual:.6g} s a step); "
            "fill it in, or cut the motion there"
        )
    return f"time_s is uneven here: a step of {step:.6g} s instead of the usual {usual:.6g} s; {_ADVICE}"


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


def with_axis(position: Array, axis: Array) -> Array:
    """Position and direction in one array, for joint interpolation."""
    return np.concatenate((position, unit(axis)), axis=1)


def unit(axis: Array) -> Array:
    """Normalizes directions. Scales first, because the square of a tiny or huge component under- or overflows."""
    scaled: Array = axis / np.abs(axis).max(axis=1, keepdims=True)
    length: Array = np.linalg.norm(scaled, axis=1, keepdims=True)
    return scaled / length

"""Measures of the hand: how still it held, and how long it paused on the way."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from punctura.exercise.coach.thresholds import HOLD_S, HOLD_SETTLE_S, PAUSE_S, SMOOTH_S
from punctura.exercise.coach.trace import Samples
from punctura.exercise.motion import PAUSE_SPEED
from punctura.exercise.ticks import Flags, Numbers


class Hold(NamedTuple):
    seconds: float  # length of the stay
    tremor: float  # m rms, of the motion that is faster than SMOOTH_S, all directions together
    drift: float  # m, the largest distance of the smoothed tip from its place at the beginning


class Pauses(NamedTuple):
    number: int
    seconds: float  # together


def hold_of(samples: Samples) -> Hold | None:
    """The longest stay in the space, after the needle has settled; None if it is shorter than HOLD_S."""
    runs = _runs(samples.in_space & np.isfinite(samples.tip).all(axis=1))
    if not runs:
        return None
    start, end = max(runs, key=lambda run: samples.time[run[1] - 1] - samples.time[run[0]])
    seconds = float(samples.time[end - 1] - samples.time[start])
    if seconds < HOLD_S:
        return None
    rows = samples.time[start:end] >= samples.time[start] + HOLD_SETTLE_S
    time, tip = samples.time[start:end][rows], samples.tip[start:end][rows]
    smooth, rest = _smooth(time, tip)
    away = np.linalg.norm(smooth - smooth[0], axis=1)
    return Hold(seconds, float(np.sqrt((rest**2).sum(axis=1).mean())), float(away.max()))


def stays_of(samples: Samples) -> int:
    """How often the needle was in the space without a break, for at least a tenth of a second."""
    return sum(samples.time[end - 1] - samples.time[start] >= 0.1 for start, end in _runs(samples.in_space))


def pauses_of(samples: Samples, until: float) -> Pauses:
    """The pauses in the tissue before the time `until`, s, of the arrival or of the end."""
    rows = (samples.time <= until) & np.isfinite(samples.tip).all(axis=1)
    time, tip, inside = samples.time[rows], samples.tip[rows], (samples.inside & ~samples.late)[rows]
    if len(time) < 3 or time[-1] - time[0] < PAUSE_S:
        return Pauses(0, 0.0)
    smooth, _ = _smooth(time, tip)
    speed = np.linalg.norm(np.gradient(smooth, time, axis=0), axis=1)
    lengths = [float(time[end - 1] - time[start]) for start, end in _runs((speed < PAUSE_SPEED) & inside)]
    lengths = [length for length in lengths if length >= PAUSE_S]
    return Pauses(len(lengths), sum(lengths))


def _smooth(time: Numbers, tip: Numbers) -> tuple[Numbers, Numbers]:
    """The moving mean over SMOOTH_S, and the rest, without the ends where the mean has too few samples."""
    step = float(np.median(np.diff(time)))
    half = max(1, int(SMOOTH_S / step / 2))
    width = 2 * half + 1
    padded = np.pad(tip, ((half, half), (0, 0)), mode="edge")
    sums = np.cumsum(np.concatenate([np.zeros((1, 3)), padded]), axis=0)
    smooth = (sums[width:] - sums[:-width]) / width
    inner = slice(half, len(tip) - half) if len(tip) > width else slice(None)
    return smooth, (tip - smooth)[inner]


def _runs(flags: Flags) -> list[tuple[int, int]]:
    """The first row of each run of true flags, and the row after its last."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(np.int8)))
    return [(int(start), int(end)) for start, end in zip(edges[::2], edges[1::2], strict=True)]

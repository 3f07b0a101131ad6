"""Where the thumb was, and how far limits cut its force, since the point came out behind the membrane."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np

from punctura.exercise.ticks import Flags, JudgedTicks, Numbers

ROUNDING_N = 0.01  # a device gives a force with an error of about this
DELAY_S = 5e-3  # a second device gives the force of an earlier tick; illustrative, for 400 Hz and more


class ThumbSoFar:
    """Takes all ticks of an attempt with a second device, in batches of any size."""

    def __init__(self, rate: float) -> None:
        """rate: of the ticks, Hz."""
        self._wanted = np.full(max(1, round(DELAY_S * rate)), np.inf)  # N, of the last ticks
        self._farthest, self._cut_to = np.nan, np.inf

    def mark(self, ticks: JudgedTicks, entering: Flags) -> JudgedTicks:
        """Returns the ticks with `farthest` and `cut_to` filled in. entering: the point comes out behind."""
        starts = np.flatnonzero(entering).tolist()
        farthest = _since(starts, ticks.thumb, self._farthest, np.fmax)
        cut_to = _since(starts, np.where(self._cut(ticks), ticks.push_felt, np.inf), self._cut_to, np.fmin)
        self._farthest, self._cut_to = float(farthest[-1]), float(cut_to[-1])
        return replace(ticks, farthest=farthest, cut_to=cut_to)

    def _cut(self, ticks: JudgedTicks) -> Flags:
        """Whether the device gives less than it was asked for in any of the last ticks: a limit cuts the force."""
        wanted = np.concatenate([self._wanted, ticks.force_scale * ticks.push])
        self._wanted = wanted[len(wanted) - len(self._wanted) :]
        least = np.lib.stride_tricks.sliding_window_view(wanted, len(self._wanted) + 1).min(axis=1)
        with np.errstate(invalid="ignore"):
            cut: Flags = ticks.push_felt < least - np.maximum(0.01 * np.abs(least), ROUNDING_N)
        return cut


def _since(starts: list[int], values: Numbers, before: float, best: np.ufunc) -> Numbers:
    """The best value since the last start, in each tick. before: of the ticks before these."""
    edges = [0, *starts, len(values)]
    parts = [best.accumulate(values[a:b]) for a, b in itertools.pairwise(edges)]
    parts[0] = best(parts[0], before)
    return np.concatenate(parts)

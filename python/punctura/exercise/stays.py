"""Measures how long the needle is in the space, for goals, measures and sentences."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from punctura.exercise.space import TargetSpace
from punctura.exercise.ticks import GONE_S, Flags, JudgedTicks, Numbers

MOST_GAP_S = 0.02  # allowed time without a reading: too short for a relevant motion of the hand


class Stays:
    """Takes all ticks of an attempt, in batches of any size."""

    def __init__(self, space: TargetSpace) -> None:
        self._space = space
        self._stays = (_Stay(), _Stay())

    def mark(self, ticks: JudgedTicks) -> JudgedTicks:
        """Returns the ticks with `in_space`, `stay` and `dwell` filled in."""
        here = ticks.age <= GONE_S
        inside = np.stack([self._space.holds(ticks, whole) & here for whole in (False, True)], axis=1)
        times = [one.add(ticks.time, inside[:, k]) for k, one in enumerate(self._stays)]
        stay, dwell = (np.stack(columns, axis=1) for columns in zip(*times, strict=True))
        return replace(ticks, in_space=inside, stay=stay, dwell=dwell)


class _Stay:
    """A stay is the time from the first tick in the space to the present one. A gap in the readings ends it."""

    def __init__(self) -> None:
        self._since: float | None = None
        self._last: float | None = None  # time of the last tick
        self._done = 0.0  # s, total of the stays that have ended

    def add(self, time: Numbers, inside: Flags) -> tuple[Numbers, Numbers]:
        """The present stay and all stays together, s, at each tick."""
        stay, dwell = np.zeros(len(time)), np.zeros(len(time))
        before = np.concatenate([[time[0] if self._last is None else self._last], time[:-1]])
        changed = np.concatenate([[False], np.diff(inside)]) | (time - before > MOST_GAP_S)
        cuts = np.flatnonzero(changed).tolist()
        for start, end in zip([0, *cuts], [*cuts, len(time)], strict=True):
            if start == end:
                continue
            if self._since is not None and (not inside[start] or changed[start]):
                self._done += before[start] - self._since
                self._since = None
            if inside[start]:
                self._since = float(time[start]) if self._since is None else self._since
                stay[start:end] = time[start:end] - self._since
            dwell[start:end] = self._done + stay[start:end]
        self._last = float(time[-1])
        return stay, dwell

"""How the needle moves: its path, its mean velocity, and how long it is in the space."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from punctura.exercise.ticks import GONE_S, Flags, JudgedTicks, Numbers, TargetSpace

RULER = 0.5e-3  # m; shorter moves, from tremor and encoder steps, are not added up


class PathSoFar(NamedTuple):
    length: float  # m, in steps of RULER
    net: float  # m
    deviation: float  # m from the line of entry


class Path:
    """The tip's path from an entry to its deepest point so far."""

    def __init__(self, entry: Numbers, direction: Numbers) -> None:
        """entry: position, m. direction: of the needle, of length 1."""
        self._entry, self._direction = entry, direction
        self._anchor = entry
        self._length = self._deviation = 0.0
        self._deepest = 0.0
        self.deepest = PathSoFar(0.0, 0.0, 0.0)

    def add(self, tip: Numbers) -> None:
        """Takes the next positions of the tip, (n, 3), m."""
        tip = tip[np.isfinite(tip).all(axis=1)]
        if len(tip) == 0:
            return
        depth = (tip - self._entry) @ self._direction
        row = int(depth.argmax())
        if depth[row] > self._deepest:
            self._deepest = float(depth[row])
            self._walk(tip[: row + 1])
            self.deepest = self.at(tip[row])
            tip = tip[row + 1 :]
        self._walk(tip)

    def at(self, tip: Numbers) -> PathSoFar:
        """The path up to this position."""
        rest = float(np.linalg.norm(tip - self._anchor))
        return PathSoFar(self._length + rest, float(np.linalg.norm(tip - self._entry)), self._deviation)

    def _walk(self, tip: Numbers) -> None:
        if len(tip) == 0:
            return
        offset = tip - self._entry
        across = offset - np.outer(offset @ self._direction, self._direction)
        self._deviation = max(self._deviation, float(np.linalg.norm(across, axis=1).max()))
        while True:
            away = np.linalg.norm(tip - self._anchor, axis=1)
            step = int((away >= RULER).argmax())
            if away[step] < RULER:
                return
            self._length += float(away[step])
            self._anchor = tip[step]
            tip = tip[step:]


TICK_S = 1e-9  # rounding of times

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
        start = np.searchsorted(time, time[rows] - self._seconds + TICK_S, side="right") - 1
        outside = np.concatenate([[0], np.cumsum(~inside)])
        first = np.maximum(start, 0)
        known: Flags = (start >= 0) & (outside[rows + 1] == outside[first])
        span = np.where(known, time[rows] - time[first], 1.0)
        moved = np.where(known[:, None], tip[rows] - tip[first], 0.0) / span[:, None]
        keep = max(0, int(start[-1]))
        self._time, self._tip, self._inside = time[keep:], tip[keep:], inside[keep:]
        return moved, known


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

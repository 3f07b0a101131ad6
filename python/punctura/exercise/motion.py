"""How the needle moves: its path, its mean velocity, where it stands still, and how long it is in the space."""

from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from punctura.events import Event
from punctura.exercise.ticks import GONE_S, LATE_S, Flags, JudgedTicks, Moment, Numbers, TargetSpace, contacts

RULER = 0.5e-3  # m; shorter moves, from tremor and encoder steps, are not added up


class PathSoFar(NamedTuple):
    length: float  # m, in steps of RULER
    net: float  # m


class Path:
    """The tip's path from an entry to its deepest point so far."""

    def __init__(self, entry: Numbers, direction: Numbers) -> None:
        """entry: position, m. direction: of the needle, of length 1."""
        self._entry, self._direction = entry, direction
        self._anchor = entry
        self._length = self._deepest = 0.0
        self.deepest = PathSoFar(0.0, 0.0)

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
        return PathSoFar(self._length + rest, float(np.linalg.norm(tip - self._entry)))

    def _walk(self, tip: Numbers) -> None:
        while len(tip):
            away = np.linalg.norm(tip - self._anchor, axis=1)
            step = int((away >= RULER).argmax())
            if away[step] < RULER:
                return
            self._length += float(away[step])
            self._anchor = tip[step]
            tip = tip[step:]


TICK_S = 1e-9  # rounding of times

PAUSE_SPEED = 0.5e-3  # m/s; a slower needle stands still
PAUSE_MEAN_S = 0.25  # over which this speed is measured: longer than a period of tremor


class MeanSpeed:
    """Takes the ticks of an attempt, in batches of any size."""

    def __init__(self, seconds: float) -> None:
        """seconds: of the mean."""
        self._seconds = seconds
        self._time, self._tip, self._inside = np.zeros(0), np.zeros((0, 3)), np.zeros(0, np.bool_)

    def add(self, ticks: JudgedTicks) -> tuple[Numbers, Flags]:
        """The mean velocity up to each tick, (n, 3), m/s, and whether it is known: the needle was in the tissue for all
        of the time, and all positions are numbers. Else 0."""
        good = ticks.in_tissue & ticks.placed
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
BLIND_S = 0.2  # in less, no hand goes somewhere and comes back: that takes two reactions. Illustrative


class Gaps:
    """Takes all ticks of an attempt, in batches of any size, and finds the times without a reading that are too long.

    What a gap hides is bounded by the readings at its two ends: where a number could change at neither end, it changed
    in a gap of up to BLIND_S not at all. Before the first contact no gap matters. The needle's own clock counts: while
    a tick of a simulated device is late, nothing moves that a reading could miss.
    """

    def __init__(self) -> None:
        self._seen_at: float | None = None  # s, of the last reading
        self._matters = self._touched = False  # at the last reading; up to the last tick

    def add(self, ticks: JudgedTicks, seen: Flags, matters: Flags) -> Flags:
        """The ticks before which a gap that matters has been too long. seen: a tick has a reading. matters: its number
        can change there."""
        rows = np.arange(len(ticks))
        last = np.concatenate([[-1], np.maximum.accumulate(np.where(seen, rows, -1))[:-1]])
        began = float(ticks.own[0]) if self._seen_at is None else self._seen_at
        gap = ticks.own - np.where(last >= 0, ticks.own[last], began)
        here = matters | np.where(last >= 0, matters[last], self._matters)
        touched = self._touched | np.logical_or.accumulate(ticks.in_tissue)
        long: Flags = (gap > MOST_GAP_S) & touched & (here | (gap > BLIND_S))
        known = np.flatnonzero(seen)
        self._seen_at = float(ticks.own[known[-1]]) if len(known) else began
        self._matters = bool(matters[known[-1]]) if len(known) else self._matters
        self._touched = bool(touched[-1])
        return long


class Ways:
    """Takes all ticks of an attempt and their events, in batches of any size: how far the point is from the line of
    entry, and how long the needle stands still on the way from the first contact to the space."""

    def __init__(self, space: TargetSpace) -> None:
        self._space, self._speed = space, MeanSpeed(PAUSE_MEAN_S)
        self._line: tuple[Numbers, Numbers] | None = None  # of the last entry: a point, m, and its direction
        self._arrived = False
        self._moved = (0.0, 0.0)  # s, at the last tick that moves: the needle's own time, and the computer's lateness
        self._silent = 0.0  # s of the present standstill in which the page was late
        self._own: float | None = None  # s, of the last tick

    def mark(self, ticks: JudgedTicks, events: list[Event]) -> JudgedTicks:
        """Returns the ticks with `aside`, `still`, `silent` and `slowed` filled in."""
        aside = self._aside(ticks, contacts(events))
        return self._standstill(replace(ticks, aside=aside))

    def _aside(self, ticks: JudgedTicks, touches: list[Moment]) -> Numbers:
        aside = np.zeros(len(ticks))
        cuts = [int(row) for row in np.searchsorted(ticks.tick, [touch.tick for touch in touches])]
        for k, (start, stop) in enumerate(pairwise([0, *cuts, len(ticks)])):
            if k:
                self._line = ticks.tip[start], ticks.held[start] * (1.0 if np.isfinite(ticks.angle[start]) else np.nan)
            if self._line is not None:
                offset = ticks.tip[start:stop] - self._line[0]
                aside[start:stop] = np.linalg.norm(np.cross(offset, self._line[1]), axis=1)
        return aside

    def _standstill(self, ticks: JudgedTicks) -> JudgedTicks:
        moved, known = self._speed.add(ticks)
        arrived = self._arrived | np.logical_or.accumulate(self._space.arrived(ticks))
        self._arrived = bool(arrived[-1])
        slow = known & ~arrived & (np.linalg.norm(moved, axis=1) < PAUSE_SPEED)
        rows, late = np.arange(len(ticks)), ticks.time - ticks.own
        step = np.diff(ticks.own, prepend=ticks.own[0] if self._own is None else self._own)
        total = self._silent + np.cumsum(np.where(slow & (ticks.age > LATE_S), step, 0.0))
        silent = total - np.maximum.accumulate(np.where(slow, 0.0, total))
        moves = np.maximum.accumulate(np.where(slow, -1, rows))
        since, late_then = np.where(moves >= 0, (ticks.own[moves], late[moves]), np.array(self._moved)[:, None])
        self._moved = float(since[-1]), float(late_then[-1])
        self._silent, self._own = float(silent[-1]), float(ticks.own[-1])
        still = np.where(slow, ticks.own - since - silent + PAUSE_MEAN_S, 0.0)
        slowed = slow & (late - late_then > MOST_GAP_S)
        return replace(ticks, still=still, silent=slow & (silent > 0), slowed=slowed)


class Stays:
    """Takes all ticks of an attempt, in batches of any size."""

    def __init__(self, space: TargetSpace) -> None:
        self._space = space
        self._stays = (_Stay(), _Stay())

    def mark(self, ticks: JudgedTicks) -> JudgedTicks:
        """Returns the ticks with `in_space`, `stay` and `dwell` filled in."""
        here = ticks.age <= GONE_S
        inside = np.stack([self._space.holds(ticks, whole) & here for whole in (False, True)], axis=1)
        times = [one.add(ticks.own, inside[:, k]) for k, one in enumerate(self._stays)]
        stay, dwell = (np.stack(columns, axis=1) for columns in zip(*times, strict=True))
        return replace(ticks, in_space=inside, stay=stay, dwell=dwell)


class _Stay:
    """A stay is the needle's own time from the first tick in the space to the present one. Missing readings end it."""

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

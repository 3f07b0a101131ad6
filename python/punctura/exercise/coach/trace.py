"""What the coach keeps of an attempt while it runs: about 3 kB a second."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from punctura.events import Event
from punctura.exercise.coach.thresholds import BEFORE_S
from punctura.exercise.space import TargetSpace
from punctura.exercise.ticks import LATE_S, Flags, JudgedTicks, Numbers

SAMPLES_HZ = 100.0  # enough for a tremor of 12 Hz
_TICK_S = 1e-9  # rounding of times


class Push(NamedTuple):
    """The needle in the BEFORE_S before a moment."""

    time: float  # s
    membrane: int  # that gave way then; -1: none
    force: float  # N, the largest total force of the model
    speed: float  # m/s along the needle; positive goes in


class _Recent(NamedTuple):
    """The last BEFORE_S at the full rate."""

    time: Numbers
    tip: Numbers
    held: Numbers
    force: Numbers


class Samples(NamedTuple):
    """The attempt at SAMPLES_HZ, or at the rate of the device if that is lower."""

    time: Numbers  # s
    tip: Numbers  # (n, 3), m
    inside: Flags  # a membrane holds the needle
    in_space: Flags  # of the point, or of the whole tip if the exercise asks for it
    late: Flags  # the page that moves the hand is late


class Trace:
    """Takes the ticks of an attempt up to its decision, in batches of any size, and their events."""

    def __init__(self, space: TargetSpace, rate: float) -> None:
        """rate: of the device, Hz."""
        self._space, self._rate = space, rate
        self._step = max(1, round(rate / SAMPLES_HZ))
        self._recent = _Recent(np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0))
        self._parts: list[Samples] = []
        self.pushes: list[Push] = []  # one a pop
        self.nearest = -np.inf  # m, the largest distance of the point behind the membrane before the space
        self.tip_nearest = -np.inf  # m, the same of the end of the slanted face
        self.pressed_s = 0.0  # time of the point behind the end of the space
        self.pressed_m = 0.0  # how far it was behind it

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        if len(ticks) == 0:
            return
        new = _Recent(ticks.time, ticks.tip, ticks.held, ticks.force)
        self._recent = _Recent(*(np.concatenate(pair) for pair in zip(self._recent, new, strict=True)))
        self.pushes += [self._push(event.time, event.membrane) for event in events if event.what == "pop"]
        late = self._recent.time > self._recent.time[-1] - BEFORE_S - _TICK_S
        self._recent = _Recent(*(column[late] for column in self._recent))
        rows = ticks.tick % self._step == 0
        in_space = ticks.in_space[rows, int(self._space.stay_whole)]
        self._parts.append(
            Samples(
                ticks.time[rows], ticks.tip[rows], ticks.inside[rows].any(axis=1), in_space, ticks.age[rows] > LATE_S
            )
        )
        self._depths(ticks)

    def _push(self, until: float, membrane: int) -> Push:
        time, tip, held, force = self._recent
        rows = (time >= until - BEFORE_S - _TICK_S) & (time <= until + _TICK_S) & np.isfinite(tip).all(axis=1)
        time, tip, held, force = time[rows], tip[rows], held[rows], force[rows]
        if len(time) < 2:
            return Push(until, membrane, 0.0, 0.0)
        strongest = float(np.fmax.reduce(force))
        speed = float((tip[-1] - tip[0]) @ held[-1] / (time[-1] - time[0]))
        return Push(until, membrane, strongest if np.isfinite(strongest) else 0.0, speed)

    def _depths(self, ticks: JudgedTicks) -> None:
        space = self._space
        held = ticks.inside[:, space.behind]
        for name, depths in (("nearest", ticks.past), ("tip_nearest", ticks.tip_past)):
            setattr(self, name, float(np.fmax(getattr(self, name), np.fmax.reduce(depths[:, space.behind]))))
        if not held.any():
            return
        beyond = np.full(len(ticks), -np.inf)
        if space.in_front_of is not None:
            beyond = np.fmax(beyond, ticks.below[:, space.in_front_of] - space.press)
        if np.isfinite(space.ends):
            beyond = np.fmax(beyond, ticks.past[:, space.behind] - space.ends)
        beyond = np.where(held, beyond, -np.inf)
        self.pressed_s += float((beyond > 0).sum()) / self._rate
        self.pressed_m = max(self.pressed_m, float(beyond.max()))

    @property
    def last(self) -> Push:
        """The needle before the last tick, that is before the decision."""
        time = self._recent.time
        return self._push(float(time[-1]), -1) if len(time) else Push(0.0, -1, 0.0, 0.0)

    @property
    def samples(self) -> Samples:
        if not self._parts:
            no = np.zeros(0, np.bool_)
            return Samples(np.zeros(0), np.zeros((0, 3)), no, no, no)
        whole = Samples(*(np.concatenate(columns) for columns in zip(*self._parts, strict=True)))
        self._parts = [whole]
        return whole

"""What is measured in an attempt, whatever its goals are."""

from __future__ import annotations

import itertools
import math

import numpy as np

from punctura import Scene
from punctura.events import Event
from punctura.exercise.path import Path, PathSoFar
from punctura.exercise.result import Metrics, Overshoot
from punctura.exercise.space import TargetSpace
from punctura.exercise.ticks import Geometry, Ticks

OVERSHOOT_S = 0.3  # after a pop: a hand's own reaction comes later


class Measures:
    """Fed with all ticks up to the decision, and their events."""

    def __init__(self, scene: Scene, geometry: Geometry, space: TargetSpace) -> None:
        self._period = 1 / scene.servo.rate
        self._normal = geometry.normals[0]
        self._names = [placed.name for placed in scene.membranes]
        self._space = space
        self.attempts = 0
        self.peak_force = 0.0
        self.first_touch: float | None = None
        self.arrival: float | None = None
        self.longest_stay = 0.0
        self._dwell_ticks = self._stay_ticks = 0
        self._overshoots: list[Overshoot] = []
        self._path: Path | None = None
        self._way: PathSoFar | None = None  # to the space, once it was reached
        self._entry_angle: float | None = None
        self._next_tick: int | None = None
        self._lost = 0
        self._last_time = 0.0

    def add(self, ticks: Ticks, events: list[Event]) -> None:
        if len(ticks) == 0:
            return
        self._count(ticks)
        touches = [event for event in events if event.what == "touch" and event.membrane == 0]
        self.attempts += len(touches)
        if touches and self.first_touch is None:
            self.first_touch = touches[0].time
        self.peak_force = max(self.peak_force, float(ticks.force.max()))
        self._run_on(ticks, [event for event in events if event.what == "pop"])
        inside = self._space.holds(ticks, whole_tip=False)
        self._follow(ticks, touches, int(inside.argmax()) if inside.any() else None)
        self._stay(inside)

    def _count(self, ticks: Ticks) -> None:
        first, last = int(ticks.tick[0]), int(ticks.tick[-1])
        self._lost += last + 1 - (first if self._next_tick is None else self._next_tick) - len(ticks)
        self._next_tick = last + 1
        self._last_time = float(ticks.time[-1])

    def _run_on(self, ticks: Ticks, pops: list[Event]) -> None:
        self._overshoots += [Overshoot(membrane=e.membrane, name=e.name, time=e.time, distance=0.0) for e in pops]
        for k, one in enumerate(self._overshoots):
            if one.time + OVERSHOOT_S < ticks.time[0]:
                continue
            rows = (ticks.time >= one.time) & (ticks.time <= one.time + OVERSHOOT_S)
            if rows.any():
                farthest = float(ticks.run_on[rows, one.membrane].max())
                self._overshoots[k] = one.model_copy(update={"distance": max(one.distance, farthest)})

    def _follow(self, ticks: Ticks, touches: list[Event], arrived: int | None) -> None:
        """The path from the last entry to the space; what comes after its first arrival is no part of it."""
        if self._way is not None:
            return
        end = len(ticks) if arrived is None else arrived + 1
        cuts = [int(row) for row in np.searchsorted(ticks.tick, [event.tick for event in touches])]
        edges = [0, *[min(cut, end) for cut in cuts], end]
        for k, (start, stop) in enumerate(itertools.pairwise(edges)):
            if k and cuts[k - 1] < end:
                self._enter(ticks, cuts[k - 1])
            if self._path is not None:
                self._path.add(ticks.tip[start:stop])
        if arrived is not None:
            self.arrival = float(ticks.time[arrived])
            if self._path is not None:
                self._way = self._path.at(ticks.tip[arrived])

    def _enter(self, ticks: Ticks, row: int) -> None:
        axis = ticks.held[row]
        self._path = Path(ticks.tip[row], axis)
        self._entry_angle = math.asin(min(1.0, float(axis @ self._normal)))

    def _stay(self, inside: np.ndarray) -> None:
        self._dwell_ticks += int(inside.sum())
        edges = [0, *(np.flatnonzero(np.diff(inside)) + 1).tolist(), len(inside)]
        for start, end in itertools.pairwise(edges):
            self._stay_ticks = self._stay_ticks + end - start if inside[start] else 0
            self.longest_stay = max(self.longest_stay, self._stay_ticks * self._period)

    def metrics(self) -> Metrics:
        way = self._way or (self._path.deepest if self._path else None)
        touched = self.first_touch
        return Metrics(
            attempts=self.attempts,
            peak_force=self.peak_force,
            overshoot=self._overshoots,
            dwell=self._dwell_ticks * self._period,
            longest_stay=self.longest_stay,
            path_length=way.length if way else None,
            net_distance=way.net if way else None,
            straightness=way.length / way.net if way and way.net > 0 else None,
            lateral_deviation=way.deviation if way else None,
            entry_angle=self._entry_angle,
            time_to_target=self.arrival - touched if self.arrival is not None and touched is not None else None,
            total_time=self._last_time - touched if touched is not None else 0.0,
            lost_ticks=self._lost,
        )

"""The judges of an exercise's limits."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from punctura import Scene
from punctura._core import grazing_cosine
from punctura.events import Event
from punctura.exercise.limit import Limit, Moment, by, first_of
from punctura.exercise.motion_limits import AngleJudge, DepthJudge, PauseJudge, SpeedJudge
from punctura.exercise.plunger import PlungerJudge
from punctura.exercise.schema import (
    AnyGoal,
    Entries,
    EntryAngle,
    ExerciseFile,
    FeelPlunger,
    MostDepth,
    MostSpeed,
    NeverPass,
    NoPause,
    OnLine,
    PeakForce,
    Reach,
    Stay,
    StopAfterPop,
    StopPlunger,
    TimeLimit,
)
from punctura.exercise.space import TargetSpace, place_of
from punctura.exercise.stop import StopJudge
from punctura.exercise.ticks import JudgedTicks


class NeverPassJudge(Limit):
    def __init__(self, goal: NeverPass, scene: Scene) -> None:
        super().__init__(goal.text or f"Do not go through the {goal.membrane}")
        self.membrane, self._whole = goal.membrane, goal.whole_tip
        self._index = place_of(scene, goal.membrane)

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self._watch(ticks, np.isfinite(ticks.past[:, self._index]))
        behind = ticks.tip_behind if self._whole else ticks.point_behind
        self._miss(ticks, behind[:, self._index])


class TimeJudge(Limit):
    """Uses the ticks' own times, so lost ticks do not stop the time."""

    def __init__(self, goal: TimeLimit) -> None:
        super().__init__(goal.text or f"Finish within {goal.seconds:g} s of the first contact")
        self.seconds = goal.seconds
        self._began: Moment | None = None

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        if self._began is None:
            touches = (Moment(e.tick, e.time) for e in events if e.what == "touch" and e.membrane == 0)
            self._began = next(touches, None)
        if self._began is not None:
            self._miss(ticks, ticks.time - self._began.time > self.seconds)

    def measured(self, until: Moment | None) -> bool:
        return self._began is not None and (until is None or self._began.tick <= until.tick)


class ForceJudge(Limit):
    def __init__(self, goal: PeakForce) -> None:
        super().__init__(goal.text or f"Push with no more than {goal.at_most_N:g} N")
        self.at_most = goal.at_most_N

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self._watch(ticks, np.isfinite(ticks.force))
        self._miss(ticks, ticks.force > self.at_most)


def across(scene: Scene, along: list[float]) -> NDArray[np.float64]:
    """The direction across a line on the first membrane's surface, of length 1; NaN if the line is upright."""
    side: NDArray[np.float64] = np.cross(np.asarray(scene.membranes[0].inward_normal, np.float64), along)
    length = float(np.linalg.norm(side))
    return side / length if length > 1e-9 else np.full(3, np.nan)


_WAYS = (("to the left", "to the right"), ("down", "up"), ("away from you", "towards you"))  # of x, y and z


class LineJudge(Limit):
    """Uses the position of the tip in the ticks in which the point is in the space."""

    def __init__(self, goal: OnLine, scene: Scene) -> None:
        super().__init__(goal.text or f"Keep the point within {goal.within_mm:g} mm of the middle line")
        self.within = goal.within_mm * 1e-3
        self.farthest: float | None = None  # m, to the side; up to the first miss
        self._point, self._across = np.asarray(goal.point_mm) * 1e-3, across(scene, goal.along)
        self.aim: float | None = None  # m to the side, where the needle points at the line's depth in the last tick
        self._normal = np.asarray(scene.membranes[0].inward_normal) / np.linalg.norm(scene.membranes[0].inward_normal)
        self._first: Moment | None = None

    @property
    def way(self) -> str:
        """Where to move a needle that points beside the line, seen by the user."""
        way = -np.sign(self.aim or 0.0) * self._across
        axis = int(np.abs(way).argmax())
        return _WAYS[axis][int(way[axis] > 0)]

    def _points(self, ticks: JudgedTicks) -> None:
        offset, held = ticks.tip[-1] - self._point, ticks.held[-1]
        left = max(0.0, -float(offset @ self._normal) / max(grazing_cosine, float(held @ self._normal)))
        aim = float((offset + left * held) @ self._across)
        self.aim = aim if np.isfinite(aim) else None

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self._points(ticks)
        aside = np.abs((ticks.tip - self._point) @ self._across)
        self._watch(ticks, np.isfinite(aside))
        here = ticks.in_space[:, 0] & np.isfinite(aside)
        if self.missed is not None or not here.any():
            return
        self._first = self._first or first_of(ticks, here)
        off = here & (aside > self.within)
        self._miss(ticks, off)
        until = here & (np.arange(len(ticks)) <= (int(off.argmax()) if off.any() else len(ticks)))
        self.farthest = max(self.farthest or 0.0, float(aside[until].max()))

    def measured(self, until: Moment | None) -> bool:
        return by(self._first, until) and super().measured(until)


class EntriesJudge(Limit):
    def __init__(self, goal: Entries, scene: Scene) -> None:
        times = "once" if goal.at_most == 1 else f"{goal.at_most} times"
        super().__init__(goal.text or f"Enter the {scene.membranes[0].name} no more than {times}")
        self.at_most = goal.at_most
        self._count = 0

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self._watch(ticks, np.isfinite(ticks.depth[:, 0]))
        for event in events:
            if event.what == "touch" and event.membrane == 0:
                self._count += 1
                if self._count > self.at_most and self.missed is None:
                    self.missed = Moment(event.tick, event.time)


def limit_of(goal: AnyGoal, file: ExerciseFile, space: TargetSpace, scene: Scene) -> Limit | None:
    """The judge of a limit; None for a goal to achieve. The scene must have the goal's membrane."""
    if isinstance(goal, Reach | Stay | FeelPlunger):
        return None
    if isinstance(goal, EntryAngle):
        return AngleJudge(goal, file, scene)
    if isinstance(goal, MostSpeed):
        return SpeedJudge(goal)
    if isinstance(goal, NoPause):
        return PauseJudge(goal, space)
    if isinstance(goal, MostDepth):
        return DepthJudge(goal, space, file.space.behind)
    if isinstance(goal, NeverPass):
        return NeverPassJudge(goal, scene)
    if isinstance(goal, StopAfterPop):
        return StopJudge(goal, scene)
    if isinstance(goal, OnLine):
        return LineJudge(goal, scene)
    if isinstance(goal, TimeLimit):
        return TimeJudge(goal)
    if isinstance(goal, PeakForce):
        return ForceJudge(goal)
    if isinstance(goal, StopPlunger):
        return PlungerJudge(goal)
    return EntriesJudge(goal, scene)

"""The judges of how the needle is moved: its angle, its speed, its pauses and its depth."""

from __future__ import annotations

import math

import numpy as np

from punctura import Scene
from punctura.events import Event
from punctura.exercise.limit import Limit, Moment, by, first_of
from punctura.exercise.schema import EntryAngle, ExerciseFile, MostDepth, MostSpeed, NoPause
from punctura.exercise.space import TargetSpace
from punctura.exercise.speed import MeanSpeed
from punctura.exercise.ticks import GONE_S, LATE_S, ROUNDING, JudgedTicks

PAUSE_SPEED = 0.5e-3  # m/s; a slower needle stands still
PAUSE_MEAN_S, SPEED_MEAN_S = 0.25, 0.1  # over which a speed is measured: longer than a period of tremor, or nearly
ROUNDING_RAD = 1e-9


def asked_angle(file: ExerciseFile) -> float:
    """The angle of entry that the exercise asks for, rad."""
    asked = (goal.angle_deg for goal in file.goal if isinstance(goal, EntryAngle) and goal.angle_deg is not None)
    return math.radians(next(asked, file.start.angle_deg))


class AngleJudge(Limit):
    """Judges each entry into the first membrane."""

    def __init__(self, goal: EntryAngle, file: ExerciseFile, scene: Scene) -> None:
        asked = file.start.angle_deg if goal.angle_deg is None else goal.angle_deg
        name = scene.membranes[0].name
        super().__init__(goal.text or f"Enter the {name} at {asked:g} degrees, within {goal.within_deg:g} degrees")
        self.asked_deg, self.within_deg = asked, goal.within_deg
        self.entered: float | None = None  # rad, of the first wrong entry
        self._first: Moment | None = None

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        for event in events:
            if event.what != "touch" or event.membrane != 0:
                continue
            when = Moment(event.tick, event.time)
            self._first = self._first or when
            angle = float(ticks.angle[np.searchsorted(ticks.tick, event.tick)])
            if not math.isfinite(angle):
                self.unseen = self.unseen or when
            elif abs(angle - math.radians(self.asked_deg)) > math.radians(self.within_deg) + ROUNDING_RAD:
                self.entered = angle if self.missed is None else self.entered
                self.missed = self.missed or when

    def measured(self, until: Moment | None) -> bool:
        return by(self._first, until) and super().measured(until)


class SpeedJudge(Limit):
    """Judges the mean speed of the last 0.1 s in the tissue, along the needle."""

    def __init__(self, goal: MostSpeed) -> None:
        super().__init__(goal.text or f"Push in with no more than {goal.at_most_mm_per_s:g} mm/s")
        self.at_most = goal.at_most_mm_per_s * 1e-3
        self._speed = MeanSpeed(SPEED_MEAN_S)

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self._watch(ticks, np.isfinite(ticks.tip.sum(axis=1)))
        moved, _ = self._speed.add(ticks)
        self._miss(ticks, np.einsum("ij,ij->i", moved, ticks.held) > self.at_most)


class PauseJudge(Limit):
    """Judges the way from first contact to arrival. A late page is no pause, and for more than 1 s no measurement."""

    def __init__(self, goal: NoPause, space: TargetSpace) -> None:
        super().__init__(goal.text or f"Do not stand still for {goal.seconds:g} s on the way to {space.name}")
        self.seconds = goal.seconds
        self._space, self._speed = space, MeanSpeed(PAUSE_MEAN_S)
        self._arrived = False
        self._still = 0.0  # s, of the present pause
        self._before: float | None = None  # time of the last tick

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self._watch(ticks, np.isfinite(ticks.tip.sum(axis=1)))
        moved, known = self._speed.add(ticks)
        arrived = self._arrived | np.logical_or.accumulate(self._space.arrived(ticks))
        self._arrived = bool(arrived[-1])
        on_the_way = known & ~arrived
        if self.gone is None:
            self.gone = first_of(ticks, on_the_way & (ticks.age > GONE_S))
        slow = on_the_way & (np.linalg.norm(moved, axis=1) < PAUSE_SPEED) & (ticks.age <= LATE_S)
        step = np.diff(ticks.time, prepend=ticks.time[0] if self._before is None else self._before)
        self._before = float(ticks.time[-1])
        total = self._still + np.cumsum(np.where(slow, step, 0.0))
        since = np.maximum.accumulate(np.where(slow, 0.0, total))  # what was counted before the present pause
        self._still = float(total[-1] - since[-1])
        self._miss(ticks, slow & (total - since >= self.seconds - PAUSE_MEAN_S))


class DepthJudge(Limit):
    """Judges the depth of the point behind the membrane before the space, along its normal."""

    def __init__(self, goal: MostDepth, space: TargetSpace, behind: str) -> None:
        self.at_most = space.ends if goal.at_most_mm is None else goal.at_most_mm * 1e-3
        self.behind, self._index = behind, space.behind
        super().__init__(goal.text or f"Keep the point within {self.at_most * 1e3:g} mm of the {behind}")

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        past = ticks.past[:, self._index]
        self._watch(ticks, np.isfinite(past))
        self._miss(ticks, past > self.at_most + ROUNDING)

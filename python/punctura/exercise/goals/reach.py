"""The goals that bring the needle into the space: `reach` and `stay`."""

from __future__ import annotations

import math
from typing import Annotated, Literal

import numpy as np

from punctura.exercise.fields import Distance, Seconds, asked
from punctura.exercise.goals.goal import Achievement, Course, Goal, SoFar
from punctura.exercise.quantities import tenths
from punctura.exercise.ticks import Flags, JudgedTicks, TargetSpace


class Reach(Goal):
    """The needle's point reaches the space; with whole_tip, the whole bevel does."""

    kind: Literal["reach"]
    whole_tip: bool = False
    depth_mm: Distance | None = None  # depth to reach, measured as in [space]; default: the start of the space

    def judge(self, course: Course) -> ReachJudge:
        return ReachJudge(self, course.target, course.space.behind)

    @property
    def depth(self) -> float | None:
        """The depth behind the far face, m; None if it only asks for the space."""
        return None if self.depth_mm is None else self.depth_mm * 1e-3


class ReachJudge(Achievement):
    def __init__(self, goal: Reach, space: TargetSpace, behind: str) -> None:
        super().__init__(goal.text or _reach_text(goal, space, behind))
        self._whole, self._depth, self._space = goal.whole_tip, goal.depth, space

    def add(self, ticks: JudgedTicks, busy: Flags) -> None:
        here = self._space.holds(ticks, self._whole, self._depth)
        self._follow(ticks, here, here, busy)


def _reach_text(goal: Reach, space: TargetSpace, behind: str) -> str:
    if goal.depth_mm is not None:
        return f"Bring the {'whole tip' if goal.whole_tip else 'point'} {goal.depth_mm:g} mm past the {behind}"
    return f"Reach {space.name}{' with the whole tip' if goal.whole_tip else ''}"


class Stay(Goal):
    """The needle stays in the space."""

    kind: Literal["stay"]
    seconds: Annotated[Seconds, asked("Stay in the goal, s")]
    whole_tip: bool = False

    def judge(self, course: Course) -> StayJudge:
        return StayJudge(self, course.target)


class StayJudge(Achievement):
    def __init__(self, goal: Stay, space: TargetSpace) -> None:
        what = "Hold the whole tip in" if goal.whole_tip else "Stay in"
        super().__init__(goal.text or f"{what} {space.name} for {goal.seconds:g} s")
        self.seconds, self.whole_tip = goal.seconds, goal.whole_tip
        self.staying = False  # in the last tick
        self._stay, self._cut = 0.0, np.nan  # s, of the last tick; when missing readings ended a stay

    def add(self, ticks: JudgedTicks, busy: Flags) -> None:
        here, stay = ticks.in_space[:, int(self.whole_tip)], ticks.stay[:, int(self.whole_tip)]
        stayed = np.concatenate([[self.staying], here[:-1]])
        anew = here & stayed & (stay < np.concatenate([[self._stay], stay[:-1]]))
        if anew.any():
            self._cut = float(ticks.time[anew][-1])
        self.staying, self._stay = bool(here[-1]), float(stay[-1])
        self.held = min(self.seconds, self._stay)
        self._follow(ticks, here & (stay >= self.seconds), here, busy)

    def instruction(self, arrived: bool, first: str, pop: str) -> str:
        if self.staying:
            return f"{self.text}. Hold still."
        # Whoever must still push is not told to stay.
        return (pop or f"{self.text}.") if arrived else first

    def why_open(self, so_far: SoFar, space: TargetSpace) -> str:
        if self.left:
            return super().why_open(so_far, space)
        if self.whole_tip and so_far.longest_stay == 0:
            return f"The whole tip was never in {space.name}."
        told = f"You stayed in {space.name} for {tenths(so_far.longest_stay)} s; the goal is {self.seconds:g} s."
        if math.isnan(self._cut):
            return told
        return f"{told} Readings were missing at {tenths(self._cut)} s of the run: there this time began anew."

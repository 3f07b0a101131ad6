"""Goals to achieve: reach the space, stay in the space, feel the plunger give way."""

from __future__ import annotations

import numpy as np

from punctura import Scene
from punctura.exercise.limit import Moment, by, first_of
from punctura.exercise.schema import AnyGoal, FeelPlunger, Reach, Stay
from punctura.exercise.space import TargetSpace, depth_of
from punctura.exercise.ticks import Flags, JudgedTicks

EMPTY = 0.99  # share of a syringe's contents; if more has left it, its plunger does not give way any more


class Achievement:
    """Met at a tick. Open again if the needle leaves the space while a limit is still being measured."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.met: Moment | None = None
        self.left = False  # it was met and is open again
        self.done = np.zeros(0, dtype=np.bool_)  # the ticks of the batch in which it is met

    def add(self, ticks: JudgedTicks, busy: Flags) -> None:
        """Takes the next ticks. busy: the ticks in which a limit is still being measured."""
        raise NotImplementedError

    def state(self, until: Moment | None) -> str:
        """ "open" or "met". until: the state at that moment."""
        return "met" if by(self.met, until) else "open"

    def _follow(self, ticks: JudgedTicks, good: Flags, here: Flags, busy: Flags) -> None:
        rows = np.arange(len(ticks))
        met = np.maximum.accumulate(np.where(good, rows, -1 if self.met else -3))
        gone = np.maximum.accumulate(np.where(~here & busy, rows, -2))
        self.done = met > gone
        self.left = not self.done[-1] and (self.left or self.met is not None or bool(good.any()))
        if not self.done[-1]:
            self.met = None
        elif self.met is None or gone[-1] >= 0:
            self.met = first_of(ticks, good & (rows > gone[-1]))


class ReachJudge(Achievement):
    def __init__(self, goal: Reach, space: TargetSpace, behind: str) -> None:
        super().__init__(goal.text or _reach_text(goal, space, behind))
        self._whole, self._depth, self._space = goal.whole_tip, depth_of(goal), space

    def add(self, ticks: JudgedTicks, busy: Flags) -> None:
        here = self._space.holds(ticks, self._whole, self._depth)
        self._follow(ticks, here, here, busy)


class StayJudge(Achievement):
    def __init__(self, goal: Stay, space: TargetSpace) -> None:
        super().__init__(goal.text or f"Stay in {space.name} for {goal.seconds:g} s")
        self.seconds, self.whole_tip = goal.seconds, goal.whole_tip
        self.staying = False  # in the last tick
        self.held = 0.0  # s, the present stay

    def add(self, ticks: JudgedTicks, busy: Flags) -> None:
        here = ticks.in_space[:, int(self.whole_tip)]
        self.staying = bool(here[-1])
        self.held = min(self.seconds, float(ticks.stay[-1, int(self.whole_tip)]))
        self._follow(ticks, here & (ticks.stay[:, int(self.whole_tip)] >= self.seconds), here, busy)


class FeelJudge(Achievement):
    """Met when the plunger gives way under a thumb that pushed hard enough when the needle came into the space."""

    def __init__(self, goal: FeelPlunger, behind: str, holds: float) -> None:
        """holds: what the syringe holds at the start, m^3."""
        text = f"Feel the plunger give way: push it with at least {goal.at_least_N:g} N through the {behind}"
        super().__init__(goal.text or text)
        self.at_least, self.behind = goal.at_least_N, behind
        self.load: float | None = None  # N, of the last time that the point came out behind the membrane
        self.injected = np.nan  # m^3 that have left the syringe in the last tick
        self._holds = holds

    @property
    def empty(self) -> bool:
        """Whether the syringe is empty, so that the plunger cannot give way any more."""
        return bool(self.injected >= EMPTY * self._holds)

    def add(self, ticks: JudgedTicks, busy: Flags) -> None:
        known = ticks.load[np.isfinite(ticks.load)]
        if len(known):
            self.load = float(known[-1])
        self.injected = float(ticks.injected[-1])
        good = ticks.gave_way & (ticks.load >= self.at_least)
        self._follow(ticks, good, np.ones(len(ticks), np.bool_), busy)


def _reach_text(goal: Reach, space: TargetSpace, behind: str) -> str:
    if goal.depth_mm is not None:
        return f"Bring the {'whole tip' if goal.whole_tip else 'point'} {goal.depth_mm:g} mm past the {behind}"
    return f"Reach {space.name}{' with the whole tip' if goal.whole_tip else ''}"


def achievement_of(goal: AnyGoal, space: TargetSpace, behind: str, scene: Scene) -> Achievement:
    """behind: name of the membrane in front of the space."""
    if isinstance(goal, Stay):
        return StayJudge(goal, space)
    if isinstance(goal, FeelPlunger):
        syringe = scene.syringe.syringe if scene.syringe else None
        return FeelJudge(goal, behind, syringe.liquid + syringe.air if syringe else np.inf)
    assert isinstance(goal, Reach)
    return ReachJudge(goal, space, behind)

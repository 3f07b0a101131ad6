"""One judge a goal: at which tick it is met, or missed."""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np

from punctura import Scene
from punctura.events import Event
from punctura.exercise.schema import (
    AnyGoal,
    Attempts,
    NeverPass,
    PeakForce,
    Reach,
    Stay,
    StopAfterPop,
    TimeLimit,
)
from punctura.exercise.space import TargetSpace, place_of
from punctura.exercise.ticks import Flags, Ticks


class Moment(NamedTuple):
    tick: int
    time: float  # s


def moment(ticks: Ticks, row: int) -> Moment:
    return Moment(int(ticks.tick[row]), float(ticks.time[row]))


class Judge:
    """A goal in the making. An achievement is met once; a limit holds until it is missed."""

    achievement = False

    def __init__(self, text: str) -> None:
        self.text = text
        self.met: Moment | None = None
        self.missed: Moment | None = None
        self.busy: Flags | None = None  # the ticks of the batch in which something is still to be seen

    def add(self, ticks: Ticks, events: list[Event]) -> None:
        raise NotImplementedError

    def state(self, until: Moment | None) -> str:
        """open, met or missed; until: as it was then."""
        for word, when in (("missed", self.missed), ("met", self.met)):
            if when is not None and (until is None or when.tick <= until.tick):
                return word
        return "open"

    def _meet(self, ticks: Ticks, flags: Flags) -> None:
        if self.met is None and flags.any():
            self.met = moment(ticks, int(flags.argmax()))

    def _miss(self, ticks: Ticks, flags: Flags) -> None:
        if self.missed is None and flags.any():
            self.missed = moment(ticks, int(flags.argmax()))


class ReachJudge(Judge):
    achievement = True

    def __init__(self, goal: Reach, space: TargetSpace) -> None:
        tip = "with the whole tip" if goal.whole_tip else ""
        super().__init__(goal.text or f"Reach {space.name} {tip}".strip())
        self._goal, self._space = goal, space

    def add(self, ticks: Ticks, events: list[Event]) -> None:
        self._meet(ticks, self._space.holds(ticks, self._goal.whole_tip))


class StayJudge(Judge):
    achievement = True

    def __init__(self, goal: Stay, space: TargetSpace) -> None:
        super().__init__(goal.text or f"Stay in {space.name} for {goal.seconds:g} s")
        self.seconds = goal.seconds
        self.since: float | None = None  # s; when the tip came into the space where it is now
        self.longest = 0.0  # s
        self.whole_tip = goal.whole_tip
        self._space = space

    def add(self, ticks: Ticks, events: list[Event]) -> None:
        inside = self._space.holds(ticks, self.whole_tip)
        edges = [0, *(np.flatnonzero(np.diff(inside)) + 1).tolist(), len(inside)]
        for start, end in itertools.pairwise(edges):
            if not inside[start]:
                self.since = None
                continue
            if self.since is None:
                self.since = float(ticks.time[start])
            stay = ticks.time[start:end] - self.since
            self.longest = max(self.longest, float(stay[-1]))
            self._meet(ticks.part(slice(start, end)), stay >= self.seconds)


class NeverPassJudge(Judge):
    def __init__(self, goal: NeverPass, scene: Scene) -> None:
        super().__init__(goal.text or f"Do not go through the {goal.membrane}")
        self.membrane, self._whole = goal.membrane, goal.whole_tip
        self._index = place_of(scene, goal.membrane)

    def add(self, ticks: Ticks, events: list[Event]) -> None:
        behind = ticks.tip_behind if self._whole else ticks.point_behind
        self._miss(ticks, behind[:, self._index])


class StopJudge(Judge):
    """What counts is the tip's place in the membrane, so that a wall that springs back counts, too."""

    def __init__(self, goal: StopAfterPop, scene: Scene) -> None:
        text = f"Run no more than {goal.within_mm:g} mm past the {goal.membrane} when it gives way"
        super().__init__(goal.text or text)
        self.membrane, self.within = goal.membrane, goal.within_mm * 1e-3
        self._seconds = goal.seconds
        self._index = place_of(scene, goal.membrane)
        self._until = -np.inf

    def add(self, ticks: Ticks, events: list[Event]) -> None:
        pops = [event for event in events if event.what == "pop" and event.membrane == self._index]
        cuts = np.searchsorted(ticks.tick, [event.tick for event in pops]).tolist()
        edges = [0, *cuts, len(ticks)]
        self.busy = np.zeros(len(ticks), dtype=np.bool_)
        for k, (start, end) in enumerate(itertools.pairwise(edges)):
            if k:
                self._until = pops[k - 1].time + self._seconds
            part = ticks.part(slice(start, end))
            past = part.run_on[:, self._index] > self.within
            self._miss(part, past & (part.time <= self._until))
            self.busy[start:end] = part.time <= self._until
            self._meet(part, (part.time > self._until) & np.isfinite(self._until))


class TimeJudge(Judge):
    def __init__(self, goal: TimeLimit) -> None:
        super().__init__(goal.text or f"Be done within {goal.seconds:g} s of the first touch")
        self.seconds = goal.seconds
        self._began: float | None = None

    def add(self, ticks: Ticks, events: list[Event]) -> None:
        if self._began is None:
            self._began = next((e.time for e in events if e.what == "touch" and e.membrane == 0), None)
        if self._began is not None:
            self._miss(ticks, ticks.time - self._began > self.seconds)


class ForceJudge(Judge):
    def __init__(self, goal: PeakForce) -> None:
        super().__init__(goal.text or f"Push with no more than {goal.at_most_N:g} N")
        self.at_most = goal.at_most_N

    def add(self, ticks: Ticks, events: list[Event]) -> None:
        self._miss(ticks, ticks.force > self.at_most)


class AttemptsJudge(Judge):
    def __init__(self, goal: Attempts, scene: Scene) -> None:
        times = "once" if goal.at_most == 1 else f"{goal.at_most} times"
        super().__init__(goal.text or f"Enter the {scene.membranes[0].name} no more than {times}")
        self.at_most = goal.at_most
        self._count = 0

    def add(self, ticks: Ticks, events: list[Event]) -> None:
        for event in events:
            if event.what == "touch" and event.membrane == 0:
                self._count += 1
                if self._count > self.at_most and self.missed is None:
                    self.missed = Moment(event.tick, event.time)


def judge_of(goal: AnyGoal, scene: Scene, space: TargetSpace) -> Judge:
    """Raises ConfigurationError where the scene does not have what the goal names."""
    if isinstance(goal, Reach):
        return ReachJudge(goal, space)
    if isinstance(goal, Stay):
        return StayJudge(goal, space)
    if isinstance(goal, NeverPass):
        return NeverPassJudge(goal, scene)
    if isinstance(goal, StopAfterPop):
        return StopJudge(goal, scene)
    if isinstance(goal, TimeLimit):
        return TimeJudge(goal)
    if isinstance(goal, PeakForce):
        return ForceJudge(goal)
    return AttemptsJudge(goal, scene)

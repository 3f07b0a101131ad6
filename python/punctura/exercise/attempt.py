"""One attempt at an exercise, followed tick by tick: live, or from a recording."""

from __future__ import annotations

from datetime import datetime, timezone
from importlib.metadata import version
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from punctura import Scene
from punctura._core import Fault, describe
from punctura.events import Event, EventFinder
from punctura.exercise import words
from punctura.exercise.exercise import Exercise
from punctura.exercise.judges import Judge, Moment, StayJudge, judge_of, moment
from punctura.exercise.measures import Measures
from punctura.exercise.result import GoalState, Result, Status
from punctura.exercise.space import space_of
from punctura.exercise.ticks import Geometry, Ticks


class Attempt:
    """Fed with batches of snapshots, cut anywhere; decided at the first tick at which a goal is missed, or all are met.

    It begins at the first tick at which the tip is in front of all membranes. What comes after the decision is not
    looked at any more.
    """

    def __init__(self, exercise: Exercise, scene: Scene) -> None:
        """scene: as it runs, at the device's rate. Raises ConfigurationError where the exercise does not fit it."""
        self.exercise, self.scene = exercise, scene
        self._space = space_of(exercise.file, scene)
        self._judges: list[Judge] = [judge_of(goal, scene, self._space) for goal in exercise.goals]
        self._geometry = Geometry(scene)
        self._measures = Measures(scene, self._geometry, self._space)
        self._finder = EventFinder(scene, scene.servo.rate)
        self._events: list[Event] = []
        self._begun = False
        self._rows = 0
        self._decision: Moment | None = None
        self._passed = False
        self._spoilt = ""  # why it cannot be judged
        self._too_deep = False  # in the last tick

    @property
    def over(self) -> bool:
        """Success or failure is decided."""
        return self._decision is not None

    def add(self, columns: dict[str, NDArray[Any]]) -> None:
        """The next ticks, as Listener.read() gives them."""
        if self.over or len(columns["depth"]) == 0:
            return
        ticks = self._geometry.ticks(columns, self._rows)
        events = self._finder.add(columns)
        self._rows += len(ticks)
        if not self._begun:
            # Where a membrane is not known, its depth says nothing.
            ready = ~(ticks.below > 0).any(axis=1) & np.isfinite(ticks.below).any(axis=1)
            if not ready.any():
                return
            self._begun = True
            ticks = ticks.part(slice(int(ready.argmax()), None))
        events = [event for event in events if event.tick >= ticks.tick[0]]
        for judge in self._judges:
            judge.add(ticks, events)
        self._decide(ticks)
        if self._decision is not None:
            ticks = ticks.part(slice(0, int(np.searchsorted(ticks.tick, self._decision.tick)) + 1))
            events = [event for event in events if event.tick <= self._decision.tick]
        self._events += events
        self._measures.add(ticks, events)
        self._too_deep = bool(self._space.too_deep(ticks)[-1] and ticks.inside[-1, self._space.in_front_of])

    def _decide(self, ticks: Ticks) -> None:
        failures = [judge.missed for judge in self._judges if judge.missed is not None]
        for flags, why in ((ticks.fault != 0, "fault"), (ticks.new_scene, "scene")):
            if flags.any():
                when = moment(ticks, int(flags.argmax()))
                if all(when.tick <= other.tick for other in failures):
                    self._spoilt = _spoilt(why, int(ticks.fault[int(flags.argmax())]))
                failures.append(when)
        success = self._success(ticks)
        failure = min(failures, default=None)
        self._decision = min((one for one in (failure, success) if one is not None), default=None)
        self._passed = success is not None and (failure is None or success.tick < failure.tick)
        if self._passed:
            self._spoilt = ""

    def _success(self, ticks: Ticks) -> Moment | None:
        """The first tick at which all is achieved and no tip is still on its way from a pop."""
        done = self._done()
        if done is None:
            return None
        good = ticks.tick >= done.tick
        for judge in self._judges:
            if judge.busy is not None:
                good &= ~judge.busy
        return moment(ticks, int(good.argmax())) if good.any() else None

    def _done(self) -> Moment | None:
        wanted = [judge.met for judge in self._judges if judge.achievement]
        return None if any(met is None for met in wanted) else max(cast(list[Moment], wanted))

    @property
    def passed(self) -> bool:
        """Everything was achieved, no limit broken; before the decision: as it stands."""
        if self._decision is not None:
            return self._passed
        return self._done() is not None

    @property
    def goals(self) -> list[GoalState]:
        """All goals as they stand."""
        states = [judge.state(self._decision) for judge in self._judges]
        if self.passed:
            states = ["met"] * len(states)
        return [GoalState(text=j.text, state=cast(Any, s)) for j, s in zip(self._judges, states, strict=True)]

    @property
    def status(self) -> Status:
        """What to do now, and the goals."""
        return Status(instruction=self._instruction(), goals=self.goals)

    def _instruction(self) -> str:
        if self.over:
            return " ".join(self._reasons())
        if self._measures.attempts == 0:
            return self.exercise.instruction
        if self._too_deep:
            wall = self.scene.membranes[self._space.in_front_of].name
            return f"You press against the {wall}: draw back a little."
        for judge in self._judges:
            if judge.achievement and judge.met is None:
                return (
                    f"{judge.text}. Hold still." if isinstance(judge, StayJudge) and judge.since else f"{judge.text}."
                )
        return self.exercise.instruction

    def _reasons(self) -> list[str]:
        first = self.scene.membranes[0].name
        if self._spoilt:
            return [self._spoilt]
        if self.passed:
            return words.passed(self._judges, self._measures, self._space, first)
        if self._decision is not None:
            now = [judge for judge in self._judges if judge.state(self._decision) == "missed"]
            return [words.missed(j, cast(Moment, j.missed), self._measures, self._space) for j in now]
        left = [judge for judge in self._judges if judge.achievement and judge.met is None]
        return list(dict.fromkeys(words.open_still(j, self._measures, self._space, first) for j in left))

    def finish(self, person: str = "", recording: str = "", date: datetime | None = None) -> Result:
        """The result as it stands: decided, or given up. date: of the attempt; now if not given."""
        when = (date or datetime.now(timezone.utc)).astimezone(timezone.utc)
        return Result(
            exercise=self.exercise.name,
            title=self.exercise.title,
            scene=self.scene.name,
            person=person,
            recording=recording,
            date=when.isoformat(timespec="seconds"),
            version=version("punctura"),
            passed=self.passed,
            reasons=self._reasons(),
            goals=self.goals,
            metrics=self._measures.metrics(),
            events=self._events,
        )


def _spoilt(why: str, fault: int) -> str:
    if why == "scene":
        return "The scene was changed during the exercise, so this attempt does not count."
    return f"The run stopped: {describe(Fault(fault))}."

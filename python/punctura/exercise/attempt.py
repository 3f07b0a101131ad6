"""One attempt at an exercise, judged tick by tick: live, or from a recording."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime, timezone
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from punctura import Scene, __version__, ticks
from punctura._core import Fault
from punctura.events import Event, EventFinder
from punctura.exercise import words
from punctura.exercise.coach import Coach
from punctura.exercise.course import asked_push, course_of, felt_membranes, judges_plunger
from punctura.exercise.exercise import Exercise
from punctura.exercise.goals import GOALS
from punctura.exercise.goals.goal import Achievement, LimitJudge
from punctura.exercise.measures import Measures
from punctura.exercise.motion import Stays, Ways
from punctura.exercise.result import Coaching, GoalState, Result, Status
from punctura.exercise.ticks import Flags, Geometry, JudgedTicks, Moment, by, first_of, moment
from punctura.exercise.yields import Yields


class Attempt:
    """Takes snapshots in batches of any size. It is decided at the first tick at which a limit is missed, or at which
    everything is achieved and no limit is still being measured.

    It begins at the first tick with the tip in front of all membranes. After the decision, only open overshoots are
    still measured.
    """

    def __init__(self, exercise: Exercise, scene: Scene, second_device: bool = False, simulated: bool = False) -> None:
        """scene: the running scene, at the device's rate. second_device: the thumb is on one, not on a key. simulated:
        the needle's device is.

        Raises ConfigurationError if the exercise does not fit the scene.
        """
        self.exercise, self.scene = exercise, scene
        course = course_of(exercise.file, scene)
        self._space = course.target
        self._judges = [goal.judge(course) for goal in exercise.goals]
        kinds = list(GOALS)
        by_kind = sorted(zip(exercise.goals, self._judges, strict=True), key=lambda one: kinds.index(one[0].kind))
        self._limits = [judge for judge in self._judges if isinstance(judge, LimitJudge)]
        self._achievements = [judge for judge in self._judges if isinstance(judge, Achievement)]
        self._geometry = Geometry(scene, simulated)
        self._stays, self._ways = Stays(self._space), Ways(self._space)
        self._yields = Yields(self._space, asked_push(exercise.file), scene.servo.rate, second_device)
        must = felt_membranes(exercise.file, scene)
        self._measures = Measures(
            scene,
            self._geometry,
            self._space,
            _windows(self._limits),
            must,
            _after_yield(self._limits),
            judges_plunger(exercise.file),
        )
        self._coach = Coach(exercise.file, scene, self._space, [judge for _, judge in by_kind])
        self._finder = EventFinder(scene, scene.servo.rate)
        self._events: list[Event] = []
        self._begun = False
        self._rows = 0
        self._decision: Moment | None = None
        self._passed = False
        self._invalid = ""  # why the attempt cannot be judged
        self._too_deep = self._inside = False  # at the last tick

    def __repr__(self) -> str:
        return f"<Attempt at {self.exercise.file.title!r}: {self._rows} ticks, over={self.over}>"

    @property
    def over(self) -> bool:
        """Whether success or failure is decided."""
        return self._decision is not None

    @property
    def settled(self) -> bool:
        """Whether it is decided and all measurements have ended."""
        return self.over and self._measures.settled

    def add(self, columns: ticks.Ticks | dict[str, NDArray[Any]]) -> None:
        """Takes the next ticks, as Listener.read() returns them."""
        if self.settled or len(columns["depth"]) == 0:
            return
        ticks = self._geometry.ticks(columns, self._rows)
        self._rows += len(ticks)
        if self.over:
            self._measures.settle(self._yields.mark(ticks))
            return
        events = self._finder.add(columns)
        if not self._begun:
            # The depth of an unknown membrane means nothing.
            ready = ~(ticks.below > 0).any(axis=1) & np.isfinite(ticks.below).any(axis=1)
            if not ready.any():
                return
            self._begun = True
            ticks = ticks.part(slice(int(ready.argmax()), None))
        events = [event for event in events if event.tick >= ticks.tick[0]]
        self._judge(self._yields.mark(self._ways.mark(self._stays.mark(ticks), events)), events)

    def _judge(self, ticks: JudgedTicks, events: list[Event]) -> None:
        for limit in self._limits:
            limit.add(ticks, events)
        self._decide(ticks)
        later = ticks.part(slice(len(ticks), None))
        if self._decision is not None:
            rows = int(np.searchsorted(ticks.tick, self._decision.tick)) + 1
            ticks, later = ticks.part(slice(0, rows)), ticks.part(slice(rows, None))
            events = [event for event in events if event.tick <= self._decision.tick]
        self._events += events
        self._measures.add(ticks, events)
        self._coach.add(ticks, events)
        self._measures.settle(later)
        self._inside = bool(ticks.inside[-1].any())
        self._too_deep = bool(self._space.too_deep(ticks)[-1] and ticks.inside[-1, self._space.behind])

    def _decide(self, ticks: JudgedTicks) -> None:
        failures = [limit.missed for limit in self._limits if limit.missed is not None]
        for flags, why in ((ticks.fault != 0, "fault"), (ticks.new_scene, "scene")):
            when = first_of(ticks, flags)
            if when is not None:
                if all(when.tick <= other.tick for other in failures):
                    self._invalid = words.invalid(why, Fault(int(ticks.fault[int(flags.argmax())])))
                failures.append(when)
        failure = min(failures, default=None)
        end = len(ticks) if failure is None else int(np.searchsorted(ticks.tick, failure.tick)) + 1
        success = self._success(ticks.part(slice(0, end)))
        self._decision = min((one for one in (failure, success) if one is not None), default=None)
        self._passed = success is not None and (failure is None or success.tick < failure.tick)
        if self._passed:
            self._invalid = ""

    def _success(self, ticks: JudgedTicks) -> Moment | None:
        """The first tick at which everything is achieved and no limit is still being measured."""
        busy: Flags = np.zeros(len(ticks), dtype=np.bool_)
        for limit in self._limits:
            if limit.busy is not None:
                busy |= limit.busy[: len(ticks)]
        good = ~busy
        for achievement in self._achievements:
            achievement.add(ticks, busy)
            good &= achievement.done
        return moment(ticks, int(good.argmax())) if good.any() else None

    @property
    def _achieved(self) -> bool:
        """Whether everything is achieved; a limit may still be open."""
        return all(one.met is not None for one in self._achievements)

    @property
    def passed(self) -> bool:
        """Whether everything was achieved, every limit was measured and kept, the force was on, and each loss of
        resistance that the exercise needs could be felt."""
        return self._passed and not self._withheld

    @property
    def _withheld(self) -> str:
        """Why an attempt that achieved everything is not judged as passed; else empty."""
        if not self._passed and (self.over or not self._achieved):
            return ""
        lost = self._measures.unfelt(ended=True)
        if self._measures.force_off:
            return "the force was off"
        if lost:
            worst = min(lost, key=lambda loss: loss.drop)
            return f"the device could not show the loss of resistance ({worst.figures})"
        return "not everything was measured" if self._unmeasured else ""

    @property
    def _unmeasured(self) -> list[LimitJudge]:
        """The limits that were not measured, once everything was achieved."""
        return [one for one in self._limits if one.state(self._decision, True) == "not measured"]

    def _goals(self, ended: bool) -> list[GoalState]:
        complete = self._passed or (ended and not self.over and self._achieved)
        states = []
        for judge in self._judges:
            if isinstance(judge, LimitJudge):
                states.append(judge.state(self._decision, complete))
            else:
                states.append("met" if self._passed else judge.state(self._decision))
        return [GoalState(text=j.text, state=cast(Any, s)) for j, s in zip(self._judges, states, strict=True)]

    @property
    def goals(self) -> list[GoalState]:
        """All goals with their present states."""
        return self._goals(ended=False)

    @property
    def status(self) -> Status:
        """The present instruction, the goals and the clock."""
        stay = max(self._achievements, key=lambda one: one.seconds, default=None)
        return Status(
            instruction=self._instruction(),
            goals=self.goals,
            held=stay.held if stay else 0.0,
            hold=stay.seconds if stay else 0.0,
            time=self._measures.elapsed,
            time_limit=min((one.time_limit for one in self._limits if one.time_limit is not None), default=None),
        )

    def _instruction(self) -> str:
        if self.over:
            return " ".join(self._reasons(ended=False))
        arrived = self._measures.arrival is not None
        urgent = [judge.alarm(self._space) for judge in self._judges]
        if not arrived:
            urgent += [limit.aiming(self._inside) for limit in self._limits]
        if any(urgent):
            return next(filter(None, urgent))
        if self._measures.entries == 0:
            return self.exercise.instruction
        if self._too_deep:
            return words.too_deep(self.exercise.file.space)
        for one in self._achievements:
            if one.met is None:
                pop = next((limit.waiting() for limit in self._limits if limit.waits_for == "pop"), "")
                return one.instruction(arrived, self.exercise.instruction, pop)
        return next(filter(None, (limit.waiting() for limit in self._limits)), self.exercise.instruction)

    def _reasons(self, ended: bool) -> list[str]:
        first = self.scene.membranes[0].name
        if self._invalid:
            return [self._invalid]
        if self._decision is not None and not self._passed:
            now = [limit for limit in self._limits if limit.state(self._decision, False) == "missed"]
            return [one.why_missed(cast(Moment, one.missed), self._measures, self._space) for one in now]
        if self._passed or self._achieved:
            lost = self._measures.unfelt(ended)
            sentences = words.passed(self._achievements, self._measures, self._space, first)
            missing = [one for one in self._unmeasured if by(one.unseen, self._decision)]
            sentences += words.readings_missing(missing)
            others = [one for one in self._unmeasured if one not in missing]
            sentences += [one.why_not_measured(self._decision, first) for one in others]
            return sentences + [words.not_felt(one) for one in lost]
        left = [one for one in self._achievements if one.met is None]
        return list(dict.fromkeys(words.open_still(one, self._measures, self._space, first) for one in left))

    def _coaching(self) -> Coaching:
        if self._invalid or self._measures.entries == 0:
            return Coaching()
        return self._coach.words(self._passed, self._decision, self._measures)

    def finish(self, person: str = "", recording: str = "", date: datetime | None = None, group: str = "") -> Result:
        """The present result; an undecided attempt counts as given up. date: of the attempt; default now."""
        when = (date or datetime.now(timezone.utc)).astimezone(timezone.utc)
        return Result(
            exercise=self.exercise.name,
            title=self.exercise.title,
            scene=self.scene.name,
            person=person,
            group=group,
            recording=recording,
            date=when.isoformat(timespec="seconds"),
            version=__version__,
            passed=self.passed,
            withheld=self._withheld,
            reasons=[
                *self._reasons(ended=True),
                *words.of_force(self._measures),
                *words.of_page(self._measures.page_late),
                *words.of_computer(self._measures.computer_late),
            ],
            goals=self._goals(ended=True),
            metrics=self._measures.metrics(),
            events=self._events,
            coaching=self._coaching(),
        )


def _windows(limits: Sequence[LimitJudge]) -> dict[int, float]:
    """By membrane: the time after a pop in which the overshoot is measured, s; the longest that a limit asks for."""
    windows: dict[int, float] = {}
    for index, seconds in filter(None, (limit.overshoot for limit in limits)):
        windows[index] = max(seconds, windows.get(index, 0.0))
    return windows


def _after_yield(limits: Sequence[LimitJudge]) -> float:
    """The time after the plunger gives way in which the injected volume is measured, s."""
    return max((limit.after_yield for limit in limits if limit.after_yield is not None), default=1.0)

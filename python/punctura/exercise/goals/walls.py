"""Goals about the membranes that the needle meets: never_pass, stop_after_pop, depth, entries."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from punctura import Scene
from punctura.errors import MISSING, Problem
from punctura.events import Event
from punctura.exercise.fields import MOST_ENTRIES, Distance, Seconds, Word, asked
from punctura.exercise.goals.goal import Course, Given, Goal, LimitJudge, SoFar, WindowJudge
from punctura.exercise.quantities import mm, more, speed, tenths, times
from punctura.exercise.result import Remark
from punctura.exercise.seen import FIRM_STOP, NEAR_STOP, REACTION_S, Seen
from punctura.exercise.ticks import (
    GONE_S,
    ROUNDING,
    Flags,
    JudgedTicks,
    Moment,
    TargetSpace,
    contacts,
    first_of,
    own_time,
    place_of,
)

# For a stylus, a mouse, keys and fingers alike.
SMALL_STEPS = "go on in small steps when the resistance grows"


class NeverPass(Goal):
    """The point never passes a membrane; with whole_tip, the whole bevel never does."""

    kind: Literal["never_pass"]
    membrane: Annotated[Word, asked("Never pass the membrane")]
    whole_tip: bool = False

    def judge(self, course: Course) -> NeverPassJudge:
        return NeverPassJudge(self, course.scene)


class NeverPassJudge(LimitJudge):
    subjects = ("line",)  # who went through the wall behind a vein did not keep to its middle

    def __init__(self, goal: NeverPass, scene: Scene) -> None:
        super().__init__(goal.text or f"Do not go through the {goal.membrane}")
        self.membrane, self._whole = goal.membrane, goal.whole_tip
        self._index = place_of(scene, goal.membrane)

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self._watch(ticks, np.isfinite(ticks.past[:, self._index]), ticks.inside[:, self._index])
        behind = ticks.tip_behind if self._whole else ticks.point_behind
        self._miss(ticks, behind[:, self._index])

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        if so_far.arrival is None:
            return f"You went through the {self.membrane} before you reached {space.name}."
        return f"You went through the {self.membrane} {tenths(when.time - so_far.arrival)} s after {space.arrival}."

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        last = seen.trajectory.last
        if last.speed <= 0:
            return  # the readings before it are missing
        since = None if seen.arrival is None or seen.decision is None else seen.decision.time - seen.arrival
        if since is not None and since >= 2 * REACTION_S:
            when, what = f", {tenths(since)} s after you reached {seen.space.name}", "draw back when the force grows"
        else:
            when, what = "", "push more slowly, so that you have time to stop"
        text = (
            f"You still moved in at {speed(last.speed)}, against {seen.newtons(last.force)}, when the point went "
            f"through the {self.membrane}{when}: {what}."
        )
        numbers = {"speed_m_per_s": last.speed, "force_N": last.force}
        yield Remark(about="through", text=text, numbers=numbers | ({} if since is None else {"after_s": since}))


class StopAfterPop(Goal):
    """After a pop, the tip moves on by at most this distance."""

    kind: Literal["stop_after_pop"]
    membrane: Word
    within_mm: Annotated[Distance, asked("After the pop, move on at most, mm")]
    seconds: Seconds = 0.3  # after the pop

    def judge(self, course: Course) -> StopJudge:
        return StopJudge(self, course.scene)

    @property
    def felt_membrane(self) -> str:
        return self.membrane


class StopJudge(WindowJudge):
    """Uses the tip's depth in the membrane, so a wall that springs back along the needle counts too.

    The measurement is open while the membrane holds a tip without a pop since its entry, and then until the window
    after the pop ends. A membrane without a pop was not measured.
    """

    def __init__(self, goal: StopAfterPop, scene: Scene) -> None:
        text = f"Run no more than {goal.within_mm:g} mm past the {goal.membrane} when it gives way"
        super().__init__(goal.text or text)
        self.membrane, self.within, self.seconds = goal.membrane, goal.within_mm * 1e-3, goal.seconds
        self.index = place_of(scene, goal.membrane)
        self.overshoot = (self.index, self.seconds)
        self._until = self._own_until = -np.inf  # the end of the last window, s; the same on the needle's own clock
        self._popped = False  # since the tip went in

    @property
    def popped(self) -> bool:
        """Whether the membrane has given way at all."""
        return bool(np.isfinite(self._until))

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        i = self.index
        pops = [event for event in events if event.what == "pop" and event.membrane == i]
        cuts = np.searchsorted(ticks.tick, [event.tick for event in pops]).tolist()
        window = np.zeros(len(ticks), dtype=np.bool_)
        for k, (start, end) in enumerate(itertools.pairwise([0, *cuts, len(ticks)])):
            if k:
                self._until = pops[k - 1].time + self.seconds
                self._own_until = own_time(ticks, pops[k - 1]) + self.seconds
            part = ticks.part(slice(start, end))
            too_far, own = part.run_on[:, i] > self.within, part.own <= self._own_until
            self._miss(part, too_far & (part.time <= self._until))
            self._lack(part, too_far & own)  # a needle that a late computer has let go on only now
            # Open until the page is heard again: a hand that it holds does not stop.
            window[start:end] = (part.time - part.age <= self._until) | own
            if self.gone is None:
                self.gone = first_of(part, window[start:end] & (part.age > GONE_S))
            if self.met is None and self.popped:
                self.met = first_of(part, ~window[start:end])
        held = ticks.inside[:, i] & ~self._popped_since_entry(ticks, cuts)
        self.busy = window | held
        self._watch(ticks, np.isfinite(ticks.depth[:, i]), self.busy)
        self.waits_for = "rest" if window[-1] else "pop" if held[-1] else ""

    def _popped_since_entry(self, ticks: JudgedTicks, pops: list[int]) -> Flags:
        rows = np.arange(len(ticks))
        out = ~ticks.inside[:, self.index] & np.isfinite(ticks.depth[:, self.index])
        popped = np.zeros(len(ticks), dtype=np.bool_)
        popped[pops] = True
        last_out = np.maximum.accumulate(np.where(out, rows, -2))
        last_pop = np.maximum.accumulate(np.where(popped, rows, -1 if self._popped else -3))
        flags: Flags = last_pop > last_out
        self._popped = bool(flags[-1])
        return flags

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        return (
            f"You ran more than {self.within * 1e3:g} mm past the {self.membrane} when it gave way: "
            "stop as soon as the resistance is gone."
        )

    def never_measured(self, first: str) -> str:
        if self.popped:
            when = f"the attempt ended within {self.seconds:g} s after the {self.membrane} gave way"
        else:
            when = f"the {self.membrane} never gave way"
        return f"Not measured: how far you moved past the {self.membrane}, because {when}."

    def waiting(self) -> str:
        if self.waits_for == "rest":
            return "Hold still."
        return f"Go on until the {self.membrane} gives way, then stop." if self.waits_for else ""

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        for push, one in seen.stops(self.index):
            if one.distance <= self.within:
                continue
            too_far = f"when the {self.membrane} gave way, and went {more(one.distance - self.within)} too far"
            # A moving hand goes on until it reacts. A hand that pushes without moving fast is let go by the wall.
            if push.speed * REACTION_S >= one.distance / 2:
                text = f"You moved at {speed(push.speed)} {too_far}: push more slowly when the resistance grows."
            else:
                text = f"You were still pushing with {seen.newtons(push.force)} {too_far}: {SMALL_STEPS}."
            numbers = {
                "speed_m_per_s": push.speed, "force_N": push.force,
                "distance_m": one.distance, "allowed_m": self.within,
            }  # fmt: skip
            yield Remark(about="stop", text=text, numbers=numbers)

    def praise(self, seen: Seen) -> Iterator[Remark]:
        stops = list(seen.stops(self.index))
        if stops and all(one.distance <= FIRM_STOP * self.within for _, one in stops):
            farthest = max(one.distance for _, one in stops)
            text = (
                f"You stopped well: only {mm(farthest)} past the {self.membrane} when it gave way; "
                f"{mm(self.within)} are allowed."
            )
            yield Remark(about="stop", text=text, numbers={"distance_m": farthest, "allowed_m": self.within})

    def advice(self, seen: Seen) -> Iterator[Remark]:
        for push, one in seen.stops(self.index):
            if self.state(seen.decision, True) == "met" and one.distance >= NEAR_STOP * self.within:
                text = (
                    f"You went {mm(one.distance)} past the {self.membrane} when it gave way; {mm(self.within)} are "
                    f"allowed: you were pushing with {seen.newtons(push.force)} at {speed(max(push.speed, 0.0))}, "
                    f"so {SMALL_STEPS}."
                )
                numbers = {"distance_m": one.distance, "allowed_m": self.within, "force_N": push.force}
                yield Remark(about="stop", text=text, numbers=numbers)


class MostDepth(Goal):
    """The point never comes deeper than this behind the far face of `behind`."""

    kind: Literal["depth"]
    # Default: the end of the space, deepest_mm.
    at_most_mm: Annotated[Distance | None, asked("Point behind the membrane at most, mm")] = None

    def judge(self, course: Course) -> DepthJudge:
        return DepthJudge(self, course.target, course.space.behind)

    @classmethod
    def problems(cls, given: Given, space: Given, scene: Scene | None) -> Iterator[Problem]:
        if (given.get("at_most_mm", 0.0), space.get("deepest_mm", 0.0)) == (None, None):
            yield Problem("at_most_mm", MISSING, "is needed: the space has no deepest_mm")


class DepthJudge(LimitJudge):
    """Judges the depth of the point behind the membrane before the space, along its normal."""

    def __init__(self, goal: MostDepth, space: TargetSpace, behind: str) -> None:
        self.at_most = space.ends if goal.at_most_mm is None else goal.at_most_mm * 1e-3
        self.behind, self._index = behind, space.behind
        super().__init__(goal.text or f"Keep the point within {self.at_most * 1e3:g} mm of the {behind}")

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        past = ticks.past[:, self._index]
        self._watch(ticks, np.isfinite(past), ticks.inside[:, self._index])
        self._miss(ticks, past > self.at_most + ROUNDING)

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        return f"The point went more than {self.at_most * 1e3:g} mm past the {self.behind}."

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        fast = max(0.0, seen.trajectory.last.speed)
        text = (
            f"You still moved in at {speed(fast)} when the point was {mm(self.at_most)} past the {self.behind}: stop "
            "as soon as it gives way."
        )
        yield Remark(about="depth", text=text, numbers={"speed_m_per_s": fast, "allowed_m": self.at_most})


class Entries(Goal):
    """The first membrane is entered at most this often."""

    kind: Literal["entries"]
    at_most: Annotated[int, Field(ge=1, le=MOST_ENTRIES), asked("Entries into the tissue, at most")]

    def judge(self, course: Course) -> EntriesJudge:
        return EntriesJudge(self, course.scene)


class EntriesJudge(LimitJudge):
    def __init__(self, goal: Entries, scene: Scene) -> None:
        often = "once" if goal.at_most == 1 else f"{goal.at_most} times"
        super().__init__(goal.text or f"Enter the {scene.membranes[0].name} no more than {often}")
        self.at_most = goal.at_most
        self._count = 0

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self._watch(ticks, np.isfinite(ticks.depth[:, 0]), ~ticks.inside[:, 0])
        for when in contacts(events):
            self._count += 1
            if self._count > self.at_most and self.missed is None:
                self.missed = when

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        return f"You entered more than {self.at_most} time{'s' * (self.at_most > 1)}."

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        yield from self.advice(seen)

    def advice(self, seen: Seen) -> Iterator[Remark]:
        again = seen.metrics.entries - 1
        if again > 0:
            text = (
                f"You came out of the {seen.first} and entered again {times(again)}: change the direction under the "
                f"{seen.first}, and do not draw the tip out."
            )
            yield Remark(about="entries", text=text, numbers={"entries": again + 1})

"""Goals about the syringe's plunger: feel_plunger, stop_plunger."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

import numpy as np

from punctura.events import Event
from punctura.exercise.fields import Push, Seconds, Volume, asked
from punctura.exercise.goals.goal import Achievement, Course, Goal, SoFar, WindowJudge
from punctura.exercise.quantities import millilitres, tenths
from punctura.exercise.result import Remark
from punctura.exercise.seen import FIRM_STOP, RESTING_N, Seen
from punctura.exercise.ticks import Flags, JudgedTicks, Moment, TargetSpace, first_of
from punctura.exercise.yields import THUMB_REACTION_S

EMPTY = 0.99  # share of a syringe's contents; if more has left it, its plunger does not give way any more


class FeelPlunger(Goal):
    """The syringe's plunger gives way under a thumb that pushes while the point comes out behind `behind`."""

    kind: Literal["feel_plunger"]
    # Force of the thumb in the last tick before.
    at_least_N: Annotated[Push, asked("Push the plunger until it gives way, N at least")] = 1.0
    needs_syringe: ClassVar[bool] = True

    def judge(self, course: Course) -> FeelJudge:
        syringe = course.scene.syringe.syringe if course.scene.syringe else None
        return FeelJudge(self, course.space.behind, syringe.liquid + syringe.air if syringe else np.inf)

    @property
    def push_N(self) -> float:
        return self.at_least_N


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

    def alarm(self, space: TargetSpace) -> str:
        if self.met is not None or not self.empty:
            return ""
        return (
            "The syringe is empty: end this attempt and try again. Push the plunger only in the tissue in front of "
            f"{space.name}."
        )

    def instruction(self, arrived: bool, first: str, pop: str) -> str:
        if not arrived:
            return super().instruction(arrived, first, pop)
        return f"Draw back into the {self.behind}, push the plunger with at least {self.at_least:g} N, and go on."

    def why_open(self, so_far: SoFar, space: TargetSpace) -> str:
        if self.empty:
            return f"The syringe was empty before the plunger could give way behind the {self.behind}."
        pushed = f"with {tenths(max(0.0, self.load))} N" if self.load is not None else "not at all"
        return (
            f"The plunger did not give way under your thumb: you pushed it {pushed} when the point came out behind the "
            f"{self.behind}; at least {self.at_least:g} N are asked."
        )

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        if self.met is not None:
            return
        if self.empty:
            text = (
                f"You emptied the syringe before the plunger could give way behind the {self.behind}: push it only "
                f"while the point is in the tissue in front of {seen.space.name}."
            )
            yield Remark(about="plunger", text=text, numbers={"injected_m3": self.injected})
        elif self.load is not None and max(0.0, self.load) < self.at_least:
            load = max(0.0, self.load)
            text = (
                f"You pushed the plunger with {load:.2f} N when the point came out behind the {self.behind}; at least "
                f"{self.at_least:g} N are asked: keep your thumb on the plunger until it gives way."
            )
            yield Remark(about="plunger", text=text, numbers={"push_N": load, "asked_N": self.at_least})


class StopPlunger(Goal):
    """After the syringe's plunger gives way, no more than this volume leaves the syringe."""

    kind: Literal["stop_plunger"]
    within_mL: Annotated[Volume, asked("In the 1 s after the plunger gives way, inject at most, mL")]
    seconds: Seconds = 1.0  # after the plunger gives way
    needs_syringe: ClassVar[bool] = True

    def judge(self, course: Course) -> PlungerJudge:
        return PlungerJudge(self)


class PlungerJudge(WindowJudge):
    """Uses the volume that has left the syringe. It is open from the tick at which the plunger gives way until the
    window ends. A plunger that never gave way was not measured."""

    def __init__(self, goal: StopPlunger) -> None:
        text = f"Inject no more than {goal.within_mL:g} mL in the {goal.seconds:g} s after the plunger gives way"
        super().__init__(goal.text or text)
        self.within, self.seconds = goal.within_mL * 1e-6, goal.seconds
        self.after_yield = goal.seconds
        self.gave_way = False
        self._until = self._own_until = -np.inf  # end of the last window, s; the same on the needle's own clock
        self._from = np.nan  # m^3, volume at the start of the last window
        self._pushes = False  # whether the thumb pushes in the last tick

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        cuts = np.flatnonzero(ticks.gave_way).tolist()
        window = np.zeros(len(ticks), dtype=np.bool_)
        for k, (start, end) in enumerate(itertools.pairwise([0, *cuts, len(ticks)])):
            if k:
                self.gave_way = True
                self._until, self._own_until = (float(clock[start]) + self.seconds for clock in (ticks.time, ticks.own))
                self._from = float(ticks.injected[start])
            part = ticks.part(slice(start, end))
            window[start:end] = part.own <= self._own_until
            too_much = part.injected - self._from > self.within
            self._miss(part, too_much & (part.time <= self._until))
            self._lack(part, too_much & window[start:end])  # a late computer let it flow only now
            if self.met is None and self.gave_way:
                self.met = first_of(part, ~window[start:end])
        self.busy = window
        # Before it gives way, the first tick of its flow may be missing.
        matters: Flags = window if self.gave_way else ticks.in_tissue
        self._watch(ticks, np.isfinite(ticks.injected), matters)
        self.waits_for = "thumb" if window[-1] else ""
        self._pushes = bool(ticks.push[-1] > RESTING_N)

    def alarm(self, space: TargetSpace) -> str:
        # A thumb that is a key or a finger feels nothing.
        return "The plunger gives way: let it go, and stop." if self.waits_for and self._pushes else ""

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        return (
            f"You injected more than {self.within * 1e6:g} mL in the {self.seconds:g} s after the plunger gave way: "
            "let the plunger go when it gives way."
        )

    def never_measured(self, first: str) -> str:
        ended = f"the attempt ended within {self.seconds:g} s after it"
        return f"Not measured: “{self.text}”, because {ended if self.gave_way else 'the plunger never gave way'}."

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        """The thumb went on when the plunger gave way."""
        one = max(seen.metrics.yields, key=lambda one: one.injected, default=None)
        if one is None:
            return
        still = one.push_after is not None and one.push_after > RESTING_N
        after = (
            f"You still pushed the plunger with {one.push_after:.2f} N {THUMB_REACTION_S:g} s after it gave way"
            if still
            else ("You pushed the plunger on when it gave way")
        )
        text = (
            f"{after}, and injected {millilitres(one.injected)}; {millilitres(self.within)} are allowed: push more "
            "gently, and let go at once."
        )
        numbers = {"push_N": one.push, "injected_m3": one.injected, "allowed_m3": self.within}
        yield Remark(
            about="plunger",
            text=text,
            numbers=numbers | ({} if one.push_after is None else {"push_after_N": one.push_after}),
        )

    def praise(self, seen: Seen) -> Iterator[Remark]:
        most = max((one.injected for one in seen.metrics.yields), default=math.inf)
        if most <= FIRM_STOP * self.within:
            text = (
                f"You let the plunger go well: only {millilitres(most)} after it gave way; {millilitres(self.within)} "
                "are allowed."
            )
            yield Remark(about="plunger", text=text, numbers={"injected_m3": most, "allowed_m3": self.within})

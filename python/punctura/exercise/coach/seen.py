"""All that the sentences about one attempt rest on."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

from punctura.exercise.achievements import Achievement, StayJudge
from punctura.exercise.coach.motion import Hold, Pauses, hold_of, pauses_of, stays_of
from punctura.exercise.coach.trace import Push, Trace
from punctura.exercise.limit import Limit, Moment
from punctura.exercise.result import Metrics, Overshoot
from punctura.exercise.space import TargetSpace
from punctura.exercise.stop import StopJudge
from punctura.exercise.words import tenths

L = TypeVar("L", bound=Limit)


@dataclass(frozen=True)
class Seen:
    passed: bool
    decision: Moment | None
    limits: Sequence[Limit]
    achievements: Sequence[Achievement]
    space: TargetSpace
    before: str  # name of the membrane before the space
    after: str  # name of the membrane behind it; empty if there is none
    first: str  # name of the first membrane
    angle: float  # that is asked between the needle and the first surface, rad
    metrics: Metrics
    first_touch: float | None  # s
    trace: Trace

    @cached_property
    def hold(self) -> Hold | None:
        """How still the needle was; None without a goal to stay, or without a stay."""
        return hold_of(self.trace.samples) if self.stay else None

    @cached_property
    def pauses(self) -> Pauses:
        return pauses_of(self.trace.samples, math.inf if self.arrival is None else self.arrival)

    @cached_property
    def stays(self) -> int:
        return stays_of(self.trace.samples)

    @property
    def stay(self) -> StayJudge | None:
        """The longest stay that is asked for."""
        stays = [one for one in self.achievements if isinstance(one, StayJudge)]
        return max(stays, key=lambda one: one.seconds, default=None)

    def newtons(self, force: float) -> str:
        """A force of the model; "model force" stands beside it if the hand did not get all of it."""
        cut = self.metrics.force_scale < 1 or any(seconds > 0 for seconds in self.metrics.force_cut.values())
        return f"{force:.2f} N (model force)" if cut else f"{force:.2f} N"

    @property
    def arrival(self) -> float | None:
        """Time of the first arrival, s."""
        waited = self.metrics.time_to_target
        return None if waited is None or self.first_touch is None else self.first_touch + waited

    def missed(self, kind: type[L]) -> Iterator[L]:
        """The limits of this kind that decided the attempt."""
        if self.passed or self.decision is None:
            return
        for limit in self.limits:
            if isinstance(limit, kind) and limit.state(self.decision, False) == "missed":
                yield limit

    def kept(self, kind: type[L]) -> Iterator[L]:
        """The limits of this kind that were measured and not missed."""
        for limit in self.limits:
            if isinstance(limit, kind) and limit.state(self.decision, True) == "met":
                yield limit

    def stops(self, goal: StopJudge) -> Iterator[tuple[Push, Overshoot]]:
        """Each pop of the goal's membrane: the needle before it, and how far it went on."""
        pushes = {round(one.time, 9): one for one in self.trace.pushes if one.membrane == goal.index}
        for one in self.metrics.overshoot:
            push = pushes.get(round(one.time, 9))
            if one.membrane == goal.index and push is not None:
                yield push, one


def mm(metres: float) -> str:
    return f"{tenths(metres * 1e3)} mm"


def millilitres(cubic_metres: float) -> str:
    return f"{tenths(cubic_metres * 1e6)} mL"


def speed(metres_per_second: float) -> str:
    fast = metres_per_second >= 9.95e-3
    return f"{metres_per_second * 1e3:.0f} mm/s" if fast else f"{tenths(metres_per_second * 1e3)} mm/s"


def degrees(radians: float) -> str:
    whole = round(math.degrees(radians))
    return f"{whole} degree{'s' * (whole != 1)}"


def times(count: int) -> str:
    return {1: "once", 2: "twice"}.get(count, f"{count} times")

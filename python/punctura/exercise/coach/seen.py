"""All that the sentences about one attempt rest on."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from punctura.exercise.coach.motion import Hold, Pauses, hold_of, pauses_of, stays_of
from punctura.exercise.coach.trace import Push, Trace
from punctura.exercise.moment import Moment
from punctura.exercise.result import Metrics, Overshoot
from punctura.exercise.space import TargetSpace


@dataclass(frozen=True)
class Seen:
    passed: bool
    decision: Moment | None
    hold_s: float | None  # the longest stay that is asked for
    timed_out: bool  # a limit of time decided the attempt
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
        return hold_of(self.trace.samples) if self.hold_s is not None else None

    @cached_property
    def pauses(self) -> Pauses:
        return pauses_of(self.trace.samples, math.inf if self.arrival is None else self.arrival)

    @cached_property
    def stays(self) -> int:
        return stays_of(self.trace.samples)

    def newtons(self, force: float) -> str:
        """A force of the model; "model force" stands beside it if the hand did not get all of it."""
        cut = self.metrics.force_scale < 1 or any(seconds > 0 for seconds in self.metrics.force_cut.values())
        return f"{force:.2f} N (model force)" if cut else f"{force:.2f} N"

    @property
    def arrival(self) -> float | None:
        """Time of the first arrival, s."""
        waited = self.metrics.time_to_target
        return None if waited is None or self.first_touch is None else self.first_touch + waited

    def stops(self, membrane: int) -> Iterator[tuple[Push, Overshoot]]:
        """Each pop of a membrane: the needle before it, and how far it went on."""
        pushes = {round(one.time, 9): one for one in self.trace.pushes if one.membrane == membrane}
        for one in self.metrics.overshoot:
            push = pushes.get(round(one.time, 9))
            if one.membrane == membrane and push is not None:
                yield push, one

"""What came out of an attempt at an exercise."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AliasChoices, BaseModel, ConfigDict, Field

from punctura.events import Event

FORMAT = 1
Finite = Annotated[float, Field(allow_inf_nan=False)]


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class GoalState(_Part):
    """A goal in words.

    At the end a limit that was kept is met, if it was measured; else it is `not measured`, and a reason says why. What
    was not decided is open.
    """

    text: str
    state: Literal["open", "met", "missed", "not measured"]


class Status(_Part):
    """How an attempt stands."""

    instruction: str  # what to do now
    goals: list[GoalState]


class Overshoot(_Part):
    """How far the tip ran on behind a membrane in the seconds after its pop."""

    membrane: int
    name: str
    time: Finite  # s, of the pop
    distance: Finite  # m along the needle
    seconds: Finite = 0.3  # after the pop: as the membrane's stop_after_pop says


class Metrics(_Part):
    """Of the attempt up to its decision (an overshoot to the end of its seconds), SI. None: there was none."""

    entries: int = Field(validation_alias=AliasChoices("entries", "attempts"))  # into the first membrane
    peak_force: Finite  # N, of the model, all membranes together
    overshoot: list[Overshoot]
    dwell: Finite  # s in the space, in all; of the whole tip where a stay goal asks for it, else of the point
    longest_stay: Finite  # s, at a time, of the same
    path_length: Finite | None  # m of the tip, from the last entry to the space, else to the deepest point
    net_distance: Finite | None  # m, straight from the one to the other
    straightness: Finite | None  # path_length / net_distance: 1 is straight
    lateral_deviation: Finite | None  # m, the largest distance from the line of entry
    entry_angle: Finite | None  # rad, between the needle and the first surface at the last entry
    time_to_target: Finite | None  # s from the first touch to the first arrival, as the reach goal wants it
    total_time: Finite  # s from the first touch to the decision
    lost_ticks: int  # that never came
    force_cut: dict[str, Finite] = {}  # s in which the device got less than peak_force counts, by limit, in words


class Result(_Part):
    """To be kept: punctura.exercise.results. `name` is under which it is kept, and empty before."""

    format: int = FORMAT
    name: str = ""
    exercise: str
    title: str
    scene: str
    person: str = ""
    recording: str = ""
    date: str  # ISO 8601, UTC
    version: str  # of Punctura
    passed: bool
    reasons: list[str]  # sentences for the student
    goals: list[GoalState]
    metrics: Metrics
    events: list[Event]

    @property
    def unmeasured(self) -> list[str]:
        """The goals that could not be measured."""
        return [goal.text for goal in self.goals if goal.state == "not measured"]

    @property
    def verdict(self) -> str:
        """In words: a pass says if something was not measured."""
        if not self.passed:
            return "not passed"
        return "passed, but not everything was measured" if self.unmeasured else "passed"

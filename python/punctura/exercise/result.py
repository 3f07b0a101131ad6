"""The result of an attempt at an exercise."""

from collections.abc import Sequence
from typing import Annotated, Literal

from pydantic import AliasChoices, BaseModel, ConfigDict, Field

from punctura.events import Event

FORMAT = 1
Finite = Annotated[float, Field(allow_inf_nan=False)]


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Remark(_Part):
    about: str  # what it is about, such as "stop"; a fixed word, for programs
    text: str  # the sentence
    numbers: dict[str, Finite] = {}  # SI, with the unit in the name
    time: Finite | None = None  # s of the run: the worst moment of what is to change, if it was one moment


class Coaching(_Part):
    """The coach's words about one attempt, the most important first. Empty if there is nothing to say."""

    good: list[Remark] = []  # what went well
    change: list[Remark] = []  # what to change next time


class GoalState(_Part):
    """A goal as a sentence, and its state.

    At the end a limit that was kept is met, if it was measured; else it is `not measured`, and a reason says why. What
    was not decided is open.
    """

    text: str  # the goal as a sentence
    state: Literal["open", "met", "missed", "not measured"]


class Status(_Part):
    """The present state of an attempt."""

    instruction: str  # what to do now
    goals: list[GoalState]  # each with its present state
    held: float = 0.0  # s, the present stay in the space, as the longest stay goal counts it
    hold: float = 0.0  # s, of that goal; 0 without one
    time: float = 0.0  # s since the first contact, up to the decision
    time_limit: float | None = None  # s, the shortest one


class Overshoot(_Part):
    """How far the tip moved on behind a membrane in the seconds after its pop."""

    membrane: int  # its number, from 0
    name: str  # of the membrane
    time: Finite  # time of the pop, s
    distance: Finite  # m along the needle
    seconds: Finite = 0.3  # length of the measurement, from the membrane's stop_after_pop goal


def drop_text(drop: float) -> str:
    """A loss of resistance in N, or "none" where the force did not fall."""
    return f"{drop:.2f} N" if drop > 0 else "none"


class FeltLoss(_Part):
    """A loss of resistance, as a hand got it. Forces in N."""

    before: Finite  # felt force
    after: Finite
    model_before: Finite  # model force at the same ticks
    model_after: Finite
    force_scale: Finite
    needed: Finite | None  # smallest drop that counts as felt; None if the exercise does not need it to be felt

    @property
    def drop(self) -> float:
        """N"""
        return self.before - self.after

    @property
    def felt(self) -> bool:
        """Whether a hand can feel it."""
        return self.needed is None or self.drop >= self.needed

    @property
    def figures(self) -> str:
        """ "0.04 N; 0.1 N needed"; "none" for a force that did not fall."""
        return f"{drop_text(self.drop)}; {self.needed or 0:.2g} N needed"


class Loss(FeltLoss):
    """The loss of resistance at a pop. Forces are along the needle.

    before: at the membrane's largest resistance, as far as the limits permitted it until the pop. after: at the pop.
    """

    membrane: int  # its number, from 0
    name: str  # of the membrane
    time: Finite  # time of the pop, s


class PlungerLoss(FeltLoss):
    """The loss of resistance at the plunger, from a second device. Forces are on the thumb.

    before: in the last tick before the point came out behind the membrane. after: the least in the time of a hand's
    reaction after the plunger gave way, for a thumb that is not drawn back.
    """

    name: str = "plunger"
    drawn_back: bool = False  # the loss would be felt, but only because the thumb was drawn back


class Yield(_Part):
    """The plunger of the syringe gave way under the thumb. Forces are the model's on the thumb, N."""

    time: Finite  # s
    push: Finite  # of the thumb in the last tick before the point came out behind the membrane
    push_after: Finite | None = None  # the largest one later than a hand's reaction; None: not measured
    loss: PlungerLoss | None = None  # None: no second device gave the thumb force, so it felt nothing
    injected: Finite  # m^3, in the seconds after it
    seconds: Finite  # length of the measurement, from the stop_plunger goal


def unfelt(losses: Sequence[Loss], yields: Sequence[Yield] = ()) -> list[Loss | PlungerLoss]:
    """Of the losses that must be felt, those that cannot be felt. For each membrane its last pop counts, and of the
    plunger the last time that it gave way."""
    last: dict[int, Loss | PlungerLoss] = {loss.membrane: loss for loss in losses if loss.needed is not None}
    plunger = [one.loss for one in yields if one.loss is not None and one.loss.needed is not None]
    return [loss for loss in [*last.values(), *plunger[-1:]] if not loss.felt]


class Metrics(_Part):
    """Measures up to the decision (overshoots: to the end of their seconds), SI. None: not available."""

    entries: int = Field(validation_alias=AliasChoices("entries", "attempts"))  # into the first membrane
    peak_force: Finite  # N, largest total force of the model
    peak_felt_force: Finite | None = None  # N, largest force on the hand, after force scale and limits
    force_scale: Finite = 1.0  # how much of the model's force the device gives, before the limits
    losses: list[Loss] = []  # of resistance, at each pop
    yields: list[Yield] = []  # of the syringe's plunger
    overshoot: list[Overshoot]  # behind each membrane that gave
    # Of the needle's own clock, on which a late computer takes no time:
    dwell: Finite  # s, total time in the space: of the whole tip if a stay goal asks for it, else of the point
    longest_stay: Finite  # s, longest time in the space without a break
    path_length: Finite | None  # m, tip's path from the last entry to the space, else to the deepest point
    net_distance: Finite | None  # m, straight distance between the same two points
    straightness: Finite | None  # path_length / net_distance: 1 is straight
    lateral_deviation: Finite | None  # m, largest distance from the line of the last entry, in the tissue
    entry_angle: Finite | None  # rad, between the needle and the first surface at the last entry
    time_to_target: Finite | None  # s, from the first contact to the first arrival, as the reach goal defines it
    total_time: Finite  # s, from the first contact to the decision
    lost_ticks: int  # that the recording lacks
    force_cut: dict[str, Finite] = {}  # s, time in which the device's force was below the model's, by limit
    page_late: Finite = 0.0  # s, time since the first contact in which the page that moves the hand was late
    computer_late: Finite = 0.0  # s, time since then in which a simulated needle stood still, because ticks were late
    force_off: Finite = 0.0  # s, time since the last entry in which the tissue gave no force to the hand


class Result(_Part):
    """A result; punctura.exercise.results saves it. `name` is the name of the saved file, empty before."""

    format: int = FORMAT  # version of the file's layout
    name: str = ""
    exercise: str  # its name
    title: str  # of the exercise
    scene: str  # its name
    person: str = ""  # who did it, if told
    group: str = ""  # the person's class
    recording: str = ""  # its file, if there is one
    date: str  # ISO 8601, UTC
    version: str  # of Punctura
    passed: bool  # all goals were met
    withheld: str = ""  # why an attempt that achieved everything is not judged as passed; else empty
    reasons: list[str]  # sentences for the student
    goals: list[GoalState]  # each with its state
    metrics: Metrics  # what was measured
    events: list[Event]  # touches, pops and exits
    coaching: Coaching = Coaching()  # empty in results of earlier versions

    @property
    def unmeasured(self) -> list[str]:
        """The goals that could not be measured."""
        return [goal.text for goal in self.goals if goal.state == "not measured"]

    @property
    def verdict(self) -> str:
        """The verdict in words. It tells if something was not measured, or could not be felt."""
        if self.withheld:
            return f"not judged as passed: {self.withheld}"
        if not self.passed:
            return "not passed"
        # Of an earlier version, for which that was a pass.
        return "passed, but not everything was measured" if self.unmeasured else "passed"

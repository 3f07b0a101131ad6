"""Messages from the server to its pages."""

from typing import Annotated, Literal

from pydantic import Field

from punctura.events import Event
from punctura.exercise.result import Status as AttemptStatus
from punctura.studio.wire.common import Finite, LawCurve, Part, ProblemPart, SceneView, Vector
from punctura.studio.wire.requests import Request, parse_request

PROTOCOL = 3  # increased when an old page cannot read a new server


class DevicePart(Part):
    backend: str
    model: str
    simulated: bool  # the page may move its hand
    has_orientation: bool
    max_force: Finite  # N, the greatest force of a run: the device's rating, or a chosen limit
    rate: Finite  # Hz


class LimitsPart(Part):
    """The limits between the model and the hand, for all runs of this studio: docs/safety.md."""

    max_force: Finite  # N
    continuous_force: Finite  # N rms in any continuous_time
    continuous_time: Finite  # s
    ramp_time: Finite  # s
    warm_motor: Finite  # share of the temperature at which a motor gets no current
    max_speed: Finite  # m/s, from one reading to the next
    stale: Finite  # s of the same reading
    deadline: Finite  # s from one tick to the next
    axis_tolerance: Finite  # by which the length of the needle's direction may differ from 1
    dead_man_buttons: list[int]  # one of them must be held; the device's first button is 1


class Choice(Part):
    """An entry of a list."""

    name: str
    title: str


class Hello(Part):
    """First on every connection."""

    kind: Literal["hello"] = "hello"
    protocol: int
    version: str
    viewer: int
    device: DevicePart
    second_device: str  # the model of the one under the thumb; empty without one
    limits: LimitsPart
    scenes: list[Choice]
    exercises: list[Choice]
    figures: bool  # the page of `punctura reproduce` exists: GET /figures/


class SceneMessage(Part):
    """After hello, and whenever the scene changes."""

    kind: Literal["scene"] = "scene"
    scene: SceneView
    new_run: bool  # ticks start at 0 again
    run: int  # its number, from 0, as frames and targets have it


class LawsMessage(Part):
    """The laws for another direction of the needle."""

    kind: Literal["laws"] = "laws"
    laws: list[LawCurve]


class HandPose(Part):
    """The target of the simulated hand."""

    position: Vector  # m
    axis: Vector  # of length 1


class Control(Part):
    kind: Literal["control"] = "control"
    holder: int | None  # a viewer
    you: bool
    hand: HandPose | None  # for the holder of control, who moves it on from there; null during strokes or a motion


class Spread(Part):
    """A distribution of times, s."""

    p50: Finite
    p99: Finite
    p99_9: Finite
    largest: Finite
    edges: list[Finite]  # s, of the bins; one more than counts
    counts: list[int]


class SecondStatus(Part):
    """The loop of the device under the thumb."""

    ticks: int
    rate: Finite  # Hz, that the device states
    max_force: Finite  # N, the limits in use
    continuous_force: Finite  # N rms
    continuous_time: Finite  # s


class Status(Part):
    """The loop's health, four times a second."""

    kind: Literal["status"] = "status"
    ticks: int
    late: int
    lost: int  # snapshots that the pages never got
    period: Spread
    compute: Spread
    viewers: int
    dropped: int  # batches that this page was too slow for
    armed: bool  # requested; each tick has the actual state
    hand: Literal["target", "strokes", "motion", "device"]
    compare: bool
    statements: list[str]  # of the devices, and notes on the run
    second: SecondStatus | None  # None without a second device


class FaultMessage(Part):
    """A latched fault; cleared when `reason` is empty."""

    kind: Literal["fault"] = "fault"
    fault: str
    reason: str  # what happened, as a sentence
    remedy: str  # what to do, as a sentence
    trouble: str  # what the device says
    tick: int | None
    kept: int  # ticks before it: GET /api/fault.csv


class MembraneEvent(Event):
    """An event at a membrane."""

    kind: Literal["event"] = "event"


class Estimated(Part):
    """A value and half of its 95 % interval, SI."""

    value: Finite
    half: Finite


class FoundPuncture(Part):
    """A puncture that the live estimate found."""

    tick: int
    depth: Finite  # m, below the first surface


class EstimateMessage(Part):
    """The live estimate: what depth and force alone tell. Four times a second while it is on."""

    kind: Literal["estimate"] = "estimate"
    on: bool
    phase: Literal["free", "rise", "behind"]  # no force yet; a membrane in contact; behind a puncture
    slope: Estimated | None  # of the force of the membrane in contact, N/m
    plateau: Estimated | None  # friction behind the last puncture, N
    punctures: int  # in this run
    drop: Finite  # N, of the last puncture
    ignored: int  # samples that were no numbers
    found: list[FoundPuncture]  # since the last message


class RecordingStatus(Part):
    kind: Literal["recording"] = "recording"
    name: str  # empty without a recording
    rows: int
    lost: int
    seconds: Finite
    trouble: str


class ExerciseStatus(AttemptStatus):
    """The state of an exercise; `running` is false without one and after its end. Times in tenths."""

    kind: Literal["exercise"] = "exercise"
    exercise: str
    running: bool
    result: str  # the name of the saved result, after the end
    blind: bool = False  # the page shows no needle and no depth while it runs


class AnswerKey(Part):
    """An answer that is possible now."""

    name: str  # that `respond` sends back
    key: str  # of the keyboard, as the browser names it


class SittingMessage(Part):
    """A participant's session (docs/perception.md): the page shows one sentence, and takes the answers."""

    kind: Literal["sitting"] = "sitting"
    question: int  # its number, which `respond` repeats
    sentence: str
    answers: list[AnswerKey]  # none: the needle is to be moved
    typed: str  # what may be typed as an answer: a number or one of the answers; empty: nothing
    covered: bool  # the view is hidden
    noise: bool  # pink noise plays, which masks the motors
    force_off: str  # this and the next two: what the page itself says
    sound: str
    gone: str


class Reply(Part):
    """The reply to the request with this id."""

    kind: Literal["reply"] = "reply"
    id: int
    ok: bool
    text: str = ""
    problems: list[ProblemPart] = Field(default_factory=list)
    data: dict[str, str | int] = Field(default_factory=dict)


class Notice(Part):
    """A sentence for the user."""

    kind: Literal["notice"] = "notice"
    text: str


Message = Annotated[
    Hello | SceneMessage | LawsMessage | Control | Status | FaultMessage | MembraneEvent | EstimateMessage
    | RecordingStatus | ExerciseStatus | SittingMessage | Reply | Notice,
    Field(discriminator="kind"),
]  # fmt: skip

__all__ = ["PROTOCOL", "Message", "Request", "parse_request"]

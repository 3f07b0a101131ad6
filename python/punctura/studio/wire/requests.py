"""What a page may ask. Each is answered by a Reply with the same id; a target is not answered."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, TypeAdapter

from punctura.studio.wire.common import Name, Part, Tables, Vector


class _Request(Part):
    id: Annotated[int, Field(ge=0, le=2**53 - 1)]


class TakeControl(_Request):
    """Control, from whoever has it. Everything below needs it."""

    do: Literal["take_control"] = "take_control"


class Arm(_Request):
    """Force, once the tip is outside tissue."""

    do: Literal["arm"] = "arm"


class Pause(_Request):
    """No force; ticks go on."""

    do: Literal["pause"] = "pause"


class Reset(_Request):
    """Leaves a fault; disarmed."""

    do: Literal["reset"] = "reset"


class Target(Part):
    """Where the simulated hand shall go. Not answered; the last one counts; one of another run is ignored."""

    do: Literal["target"] = "target"
    run: Annotated[int, Field(ge=0, le=2**53 - 1)]  # as the last scene message has it
    position: Vector  # m
    axis: Vector  # where the stylus points, of any length but 0
    buttons: Annotated[int, Field(ge=0, le=2**32 - 1)] = 0


class Strokes(_Request):
    """The simulated hand strokes to and fro through all membranes, until the next target."""

    do: Literal["strokes"] = "strokes"
    period: Annotated[float, Field(ge=0.5, le=60, allow_inf_nan=False)] = 4.0  # s, in and out


class PlayMotion(_Request):
    """The simulated hand follows a recording's tip, until its end or the next target."""

    do: Literal["play_motion"] = "play_motion"
    recording: Name


class Edit(_Request):
    """Another scene in place of the present one, taken between two ticks and faded in. A bad one changes nothing."""

    do: Literal["edit"] = "edit"
    tables: Tables


class Load(_Request):
    """A ready scene by name, as a new run."""

    do: Literal["load"] = "load"
    scene: Name


class LoadText(_Request):
    """A scene file's text, as a new run."""

    do: Literal["load_text"] = "load_text"
    toml: Annotated[str, Field(max_length=200_000)]


class Compare(_Request):
    """Runs the other solver beside the present one, for the eye only."""

    do: Literal["compare"] = "compare"
    on: bool


class StartRecording(_Request):
    """Records from a new run on, so that it can be run again to the last bit. Without a name it gets date and time."""

    do: Literal["start_recording"] = "start_recording"
    name: Name | None = None


class StopRecording(_Request):
    do: Literal["stop_recording"] = "stop_recording"


class StartExercise(_Request):
    """A new run with the exercise's scene, recorded."""

    do: Literal["start_exercise"] = "start_exercise"
    exercise: Name
    person: Annotated[str, Field(max_length=80)] = ""


class EndExercise(_Request):
    do: Literal["end_exercise"] = "end_exercise"


class TripFault(_Request):
    """Makes the gate see a position that is no number: to try what a fault is like. Simulated device only."""

    do: Literal["trip_fault"] = "trip_fault"


NumberedRequest = (
    TakeControl | Arm | Pause | Reset | Strokes | PlayMotion | Edit | Load | LoadText | Compare
    | StartRecording | StopRecording | StartExercise | EndExercise | TripFault
)  # fmt: skip
Request = Annotated[
    TakeControl | Arm | Pause | Reset | Target | Strokes | PlayMotion | Edit | Load | LoadText | Compare
    | StartRecording | StopRecording | StartExercise | EndExercise | TripFault,
    Field(discriminator="do"),
]  # fmt: skip

_ADAPTER: TypeAdapter[Request] = TypeAdapter(Request)


def parse_request(text: str | bytes) -> Request:
    """Raises pydantic.ValidationError for anything that is no request."""
    return _ADAPTER.validate_json(text)

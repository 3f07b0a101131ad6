"""Requests of a page. Each gets a Reply with the same id, except a target."""

from typing import Annotated, Literal

from pydantic import Field, TypeAdapter

from punctura.studio.wire.common import Name, Part, Tables, Vector


class _Request(Part):
    id: Annotated[int, Field(ge=0, le=2**53 - 1)]


class TakeControl(_Request):
    """Takes control from the page that has it. All other requests need control."""

    do: Literal["take_control"] = "take_control"


class Arm(_Request):
    """Allows force once the tip is outside tissue."""

    do: Literal["arm"] = "arm"


class Pause(_Request):
    """Ends the force; ticks continue."""

    do: Literal["pause"] = "pause"


class Reset(_Request):
    """Clears a fault; the loop stays disarmed."""

    do: Literal["reset"] = "reset"


class Target(Part):
    """Moves the simulated hand. No reply; a later target replaces it; a target of another run is ignored."""

    do: Literal["target"] = "target"
    run: Annotated[int, Field(ge=0, le=2**53 - 1)]  # from the last scene message
    position: Vector  # m
    axis: Vector  # direction of the stylus, of any length but 0
    buttons: Annotated[int, Field(ge=0, le=2**32 - 1)] = 0


class Awake(Part):
    """The page can move the hand: about ten times a second while an exercise runs. No reply."""

    do: Literal["awake"] = "awake"


class Took(Part):
    """The page has taken a message with ticks. From its first `took` on, few are on the way. No reply."""

    do: Literal["took"] = "took"


class Strokes(_Request):
    """The simulated hand strokes through all membranes and back, until the next target."""

    do: Literal["strokes"] = "strokes"
    period: Annotated[float, Field(ge=0.5, le=60, allow_inf_nan=False)] = 4.0  # s, in and out


class PushPlunger(_Request):
    """A simulated thumb pushes the plunger of the scene's syringe. It lets go after 1 s without a further request."""

    do: Literal["push_plunger"] = "push_plunger"
    force: Annotated[float, Field(ge=0, le=15, allow_inf_nan=False)]  # N


class PlayMotion(_Request):
    """The simulated hand follows a recording's tip, until its end or the next target."""

    do: Literal["play_motion"] = "play_motion"
    recording: Name


class Edit(_Request):
    """Exchanges the scene between two ticks; the force fades over. A scene with errors changes nothing."""

    do: Literal["edit"] = "edit"
    tables: Tables


class Load(_Request):
    """Starts a new run with a ready scene."""

    do: Literal["load"] = "load"
    scene: Name


class LoadText(_Request):
    """Starts a new run with the text of a scene file."""

    do: Literal["load_text"] = "load_text"
    toml: Annotated[str, Field(max_length=200_000)]


class Compare(_Request):
    """Runs the other solver in parallel, for display only."""

    do: Literal["compare"] = "compare"
    on: bool


class Estimate(_Request):
    """Estimates slope, friction and punctures of the run from depth and force alone, for display only."""

    do: Literal["estimate"] = "estimate"
    on: bool


class StartRecording(_Request):
    """Starts a new run and records it, so that it can be replayed bit for bit. The default name is date and scene."""

    do: Literal["start_recording"] = "start_recording"
    name: Name | None = None


class StopRecording(_Request):
    do: Literal["stop_recording"] = "stop_recording"


class StartExercise(_Request):
    """Starts a recorded run with the exercise's scene."""

    do: Literal["start_exercise"] = "start_exercise"
    exercise: Name
    person: Annotated[str, Field(max_length=80)] = ""
    group: Annotated[str, Field(max_length=80)] = ""  # the person's class


class SetExpert(_Request):
    """Names a recording as the expert's run of an exercise; an empty name removes it."""

    do: Literal["set_expert"] = "set_expert"
    exercise: Name
    recording: Annotated[str, Field(max_length=80)] = ""


class CheckExercise(_Request):
    """Checks the tables of an exercise file. The reply has the text of the file, or the problems."""

    do: Literal["check_exercise"] = "check_exercise"
    tables: Tables


class TryExercise(_Request):
    """Starts an exercise that was not saved. Its name is `draft`."""

    do: Literal["try_exercise"] = "try_exercise"
    tables: Tables
    person: Annotated[str, Field(max_length=80)] = ""
    group: Annotated[str, Field(max_length=80)] = ""


class SaveExercise(_Request):
    """Saves an exercise in the user's folder of exercises, under a name without a path."""

    do: Literal["save_exercise"] = "save_exercise"
    name: Name
    tables: Tables
    replace: bool = False


class OpenExercise(_Request):
    """Checks an exercise file of the page's computer, and keeps it in the user's folder of exercises as it is."""

    do: Literal["open_exercise"] = "open_exercise"
    name: Name  # of the file, without its ending
    file: Annotated[str, Field(max_length=200_000)]  # the bytes in base64: the studio itself tells what is no text
    replace: bool = False


class DeleteExercise(_Request):
    """Deletes an exercise that was saved or opened by the page."""

    do: Literal["delete_exercise"] = "delete_exercise"
    name: Name


class EndExercise(_Request):
    do: Literal["end_exercise"] = "end_exercise"


class Respond(_Request):
    """The answer to a question of a participant's session. One to another question is ignored."""

    do: Literal["respond"] = "respond"
    question: Annotated[int, Field(ge=0, le=2**53 - 1)]
    answer: Annotated[str, Field(max_length=80)]


class Sound(_Request):
    """Whether the page plays the masking noise of a participant's session. Browsers refuse it before a key or click."""

    do: Literal["sound"] = "sound"
    plays: bool


class TripFault(_Request):
    """Feeds the gate a position that is not a number, to demonstrate a fault. Simulated device only."""

    do: Literal["trip_fault"] = "trip_fault"


NumberedRequest = (
    TakeControl | Arm | Pause | Reset | Strokes | PushPlunger | PlayMotion | Edit | Load | LoadText | Compare
    | Estimate | StartRecording | StopRecording | StartExercise | EndExercise | SetExpert
    | CheckExercise | TryExercise | SaveExercise | OpenExercise | DeleteExercise | Respond | Sound | TripFault
)  # fmt: skip
Request = Annotated[NumberedRequest | Target | Awake | Took, Field(discriminator="do")]

_ADAPTER: TypeAdapter[Request] = TypeAdapter(Request)


def parse_request(text: str | bytes) -> Request:
    """Raises pydantic.ValidationError for anything that is not a request."""
    return _ADAPTER.validate_json(text)

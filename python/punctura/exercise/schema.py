"""The exercise file, described once (docs/exercises.md). A number's unit stands in its key."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field
from pydantic.json_schema import JsonSchemaValue

from punctura.exercise.bounds import DEEPEST_MM, LEAST_MM, LEAST_N, LEAST_S, MOST_ENTRIES, MOST_N, MOST_S
from punctura.files.tables import Table

Text = Annotated[str, Field(min_length=1, max_length=2000)]
Word = Annotated[str, Field(min_length=1, max_length=200)]
Number = Annotated[float, Field(allow_inf_nan=False)]
Depth = Annotated[float, Field(allow_inf_nan=False, ge=0, le=DEEPEST_MM)]
Distance = Annotated[float, Field(allow_inf_nan=False, ge=LEAST_MM, le=DEEPEST_MM)]
Seconds = Annotated[float, Field(allow_inf_nan=False, ge=LEAST_S, le=MOST_S)]
Newtons = Annotated[float, Field(allow_inf_nan=False, ge=LEAST_N, le=MOST_N)]
Vector = Annotated[list[Number], Field(min_length=3, max_length=3)]


class Start(Table):
    """Where the needle waits, and where it points."""

    position_mm: Vector
    angle_deg: Annotated[float, Field(gt=10, le=90)] = 90.0  # between the needle and the first membrane's surface
    heading: Vector = Field([1.0, 0.0, 0.0])  # where a slanted needle points, seen from in front of the surface


class Space(Table):
    """The space to reach: behind one membrane. It may end in front of another, at a depth, or nowhere.

    Depths are measured from the far face of `behind`, along that membrane's normal.
    """

    name: Word  # as sentences have it: "the vein"
    behind: Word  # names of membranes of the scene
    in_front_of: Word | None = None
    depth_mm: Depth = 0.0  # where the space begins
    deepest_mm: Distance | None = None  # where it ends
    sign: Word | None = None  # by which one knows: "the flash-back"
    press_mm: Depth = 0.0  # how deep the point may be in the second membrane


class _Goal(Table):
    text: Word | None = None  # in place of the sentence that is made from the goal


class Reach(_Goal):
    """The needle's point comes into the space; with whole_tip its slanted face, too."""

    kind: Literal["reach"]
    whole_tip: bool = False
    depth_mm: Distance | None = None  # that it must come to, as in [space]; where the space begins, if not given


class Stay(_Goal):
    """... and stays there."""

    kind: Literal["stay"]
    seconds: Seconds
    whole_tip: bool = False


class NeverPass(_Goal):
    """The point never comes out behind a membrane; with whole_tip: the slanted face."""

    kind: Literal["never_pass"]
    membrane: Word
    whole_tip: bool = False


class StopAfterPop(_Goal):
    """After a pop the tip runs on by no more than this."""

    kind: Literal["stop_after_pop"]
    membrane: Word
    within_mm: Distance
    seconds: Seconds = 0.3  # after the pop


class TimeLimit(_Goal):
    """Everything is done in this time from the first touch on."""

    kind: Literal["time_limit"]
    seconds: Seconds


class PeakForce(_Goal):
    """The model's force, all membranes together, stays below."""

    kind: Literal["peak_force"]
    at_most_N: Newtons


class Entries(_Goal):
    """The first membrane is entered no more often."""

    kind: Literal["entries"]
    at_most: Annotated[int, Field(ge=1, le=MOST_ENTRIES)]


AnyGoal = Annotated[
    Reach | Stay | NeverPass | StopAfterPop | TimeLimit | PeakForce | Entries, Field(discriminator="kind")
]


class ExerciseFile(Table):
    """An exercise: a scene, what to do in it, and by what it is judged."""

    title: Word
    description: Text
    instruction: Text
    scene: Word  # a ready scene's name, or a scene file beside this one
    start: Start
    space: Space
    goal: Annotated[list[AnyGoal], Field(min_length=1)]


def exercise_json_schema() -> JsonSchemaValue:
    """JSON Schema of exercise files."""
    return ExerciseFile.model_json_schema()

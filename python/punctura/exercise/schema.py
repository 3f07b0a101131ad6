"""The schema of exercise files (docs/exercises.md). Keys end in the unit of their number."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field
from pydantic.json_schema import JsonSchemaValue

from punctura.exercise.bounds import (
    DEEPEST_MM,
    LEAST_DEG,
    LEAST_ML,
    LEAST_MM,
    LEAST_MM_PER_S,
    LEAST_N,
    LEAST_PUSH_N,
    LEAST_S,
    MOST_DEG,
    MOST_ENTRIES,
    MOST_ML,
    MOST_MM_PER_S,
    MOST_N,
    MOST_PUSH_N,
    MOST_S,
)
from punctura.files.fields import LONGEST_NAME
from punctura.files.tables import Table

Text = Annotated[str, Field(min_length=1, max_length=2000)]
Word = Annotated[str, Field(min_length=1, max_length=LONGEST_NAME)]
Number = Annotated[float, Field(allow_inf_nan=False)]
Depth = Annotated[float, Field(allow_inf_nan=False, ge=0, le=DEEPEST_MM)]
Distance = Annotated[float, Field(allow_inf_nan=False, ge=LEAST_MM, le=DEEPEST_MM)]
Seconds = Annotated[float, Field(allow_inf_nan=False, ge=LEAST_S, le=MOST_S)]
Newtons = Annotated[float, Field(allow_inf_nan=False, ge=LEAST_N, le=MOST_N)]
Angle = Annotated[float, Field(gt=10, le=90)]  # between the needle and the first membrane's surface
Tolerance = Annotated[float, Field(allow_inf_nan=False, ge=LEAST_DEG, le=MOST_DEG)]
Speed = Annotated[float, Field(allow_inf_nan=False, ge=LEAST_MM_PER_S, le=MOST_MM_PER_S)]
Push = Annotated[float, Field(allow_inf_nan=False, ge=LEAST_PUSH_N, le=MOST_PUSH_N)]
Volume = Annotated[float, Field(allow_inf_nan=False, ge=LEAST_ML, le=MOST_ML)]
Vector = Annotated[list[Number], Field(min_length=3, max_length=3)]


class Start(Table):
    """Position and direction of the needle at the start."""

    position_mm: Vector
    angle_deg: Angle = 90.0
    heading: Vector = Field([1.0, 0.0, 0.0])  # direction of a slanted needle along the surface


class Space(Table):
    """The space to reach, behind one membrane. It ends in front of another membrane, at a depth, or not at all.

    Depths are measured from the far face of `behind`, along that membrane's normal.
    """

    name: Word  # name for sentences, such as "the vein"
    behind: Word  # name of a membrane of the scene, as is in_front_of
    in_front_of: Word | None = None
    depth_mm: Depth = 0.0  # where the space begins
    deepest_mm: Distance | None = None  # where it ends
    sign: Word | None = None  # sign of the arrival, such as "the flash-back"
    sign_is_felt: bool | None = None  # the device must show the pop of `behind`; default: unless there is another sign
    press_mm: Depth = 0.0  # how deep the point may be in the second membrane


class _Goal(Table):
    text: Word | None = None  # replaces the generated sentence


class Reach(_Goal):
    """The needle's point reaches the space; with whole_tip, the whole bevel does."""

    kind: Literal["reach"]
    whole_tip: bool = False
    depth_mm: Distance | None = None  # depth to reach, measured as in [space]; default: the start of the space


class Stay(_Goal):
    """The needle stays in the space."""

    kind: Literal["stay"]
    seconds: Seconds
    whole_tip: bool = False


class NeverPass(_Goal):
    """The point never passes a membrane; with whole_tip, the whole bevel never does."""

    kind: Literal["never_pass"]
    membrane: Word
    whole_tip: bool = False


class StopAfterPop(_Goal):
    """After a pop, the tip moves on by at most this distance."""

    kind: Literal["stop_after_pop"]
    membrane: Word
    within_mm: Distance
    seconds: Seconds = 0.3  # after the pop


class TimeLimit(_Goal):
    """Everything is finished within this time after the first contact."""

    kind: Literal["time_limit"]
    seconds: Seconds


class PeakForce(_Goal):
    """The model's total force stays at or below this."""

    kind: Literal["peak_force"]
    at_most_N: Newtons


class OnLine(_Goal):
    """While the point is in the space, it is not farther to the side of a line than this.

    The distance is measured along the first membrane's surface, at a right angle to the line.
    """

    kind: Literal["on_line"]
    point_mm: Vector  # any point of the line
    along: Vector  # its direction
    within_mm: Distance


class Entries(_Goal):
    """The first membrane is entered at most this often."""

    kind: Literal["entries"]
    at_most: Annotated[int, Field(ge=1, le=MOST_ENTRIES)]


class EntryAngle(_Goal):
    """At each entry into the first membrane, the needle has this angle to its surface."""

    kind: Literal["entry_angle"]
    angle_deg: Angle | None = None  # default: the angle of the start
    within_deg: Tolerance


class MostSpeed(_Goal):
    """In tissue, the point never moves in faster than this."""

    kind: Literal["speed"]
    at_most_mm_per_s: Speed


class NoPause(_Goal):
    """On the way from the first contact to the space, the needle never stands still for so long."""

    kind: Literal["no_pause"]
    seconds: Seconds = 1.0


class MostDepth(_Goal):
    """The point never comes deeper than this behind the far face of `behind`."""

    kind: Literal["depth"]
    at_most_mm: Distance | None = None  # default: the end of the space, deepest_mm


class FeelPlunger(_Goal):
    """The syringe's plunger gives way under a thumb that pushes while the point comes out behind `behind`."""

    kind: Literal["feel_plunger"]
    at_least_N: Push = 1.0  # force of the thumb in the last tick before


class StopPlunger(_Goal):
    """After the syringe's plunger gives way, no more than this volume leaves the syringe."""

    kind: Literal["stop_plunger"]
    within_mL: Volume
    seconds: Seconds = 1.0  # after the plunger gives way


AnyGoal = Annotated[
    Reach
    | Stay
    | NeverPass
    | StopAfterPop
    | OnLine
    | TimeLimit
    | PeakForce
    | Entries
    | EntryAngle
    | MostSpeed
    | NoPause
    | MostDepth
    | FeelPlunger
    | StopPlunger,
    Field(discriminator="kind"),
]


class ExerciseFile(Table):
    """An exercise: a scene, a task in it, and its goals."""

    title: Word
    description: Text
    instruction: Text
    scene: Word  # a ready scene's name, or the path of a scene file relative to this file
    level: Annotated[int, Field(ge=1, le=100)] = 100  # place in the list of the ready exercises: the easiest first
    blind: bool = False  # the page shows no needle and no depth while the exercise runs
    start: Start
    space: Space
    goal: Annotated[list[AnyGoal], Field(min_length=1)]


def exercise_json_schema() -> JsonSchemaValue:
    """JSON Schema of exercise files."""
    return ExerciseFile.model_json_schema()

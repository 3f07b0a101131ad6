"""The keys of an exercise file's start and space, and the types of all keys. Keys end in the unit of their number."""

import math
from typing import Annotated, Any

from pydantic import Field

from punctura.files.fields import LONGEST_NAME
from punctura.files.tables import Table

# A desktop device moves a needle by at most 0.4 m, so values beyond these bounds are typing errors.
FARTHEST_START_MM = 500.0  # from the scene's origin
DEEPEST_MM = 200.0  # for every depth and distance in tissue; the longest spinal needles have 180 mm

# Two encoder steps of a desktop device: shorter lengths are lost in the encoder noise.
LEAST_MM = 0.1  # for every depth and distance, the width of a space, and the distance from the start to a membrane

LEAST_S, MOST_S = 0.01, 3600.0  # for every time
LEAST_N, MOST_N = 0.001, 1000.0  # for a force
MOST_ENTRIES = 1000
LEAST_DEG, MOST_DEG = 1.0, 45.0  # for a tolerance of an angle
LEAST_MM_PER_S, MOST_MM_PER_S = 0.5, 1000.0  # for a speed; a slower needle stands still
LEAST_PUSH_N, MOST_PUSH_N = 0.1, 15.0  # of a thumb; the simulated thumb pushes with at most 15 N
LEAST_ML, MOST_ML = 0.01, 100.0  # for a volume; the largest syringes have 60 mL

# Bounds of a heading vector's length. Beyond them, computing with it loses digits or overflows.
LEAST_HEADING, MOST_HEADING = 1e-3, 1e3

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


def asked(label: str) -> Any:
    """The key with which a form asks for a goal. label: of the form's field, with the unit."""
    return Field(json_schema_extra={"x-label": label})


def no_direction(vector: list[float]) -> str:
    """The reason why three numbers are no direction; empty if they are one."""
    if LEAST_HEADING <= math.hypot(*vector) <= MOST_HEADING:
        return ""
    return f"must be a direction whose length is from {LEAST_HEADING:g} to {MOST_HEADING:g}"


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

"""The keys of an exercise file's start and space, and the types of all keys. Keys end in the unit of their number."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

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

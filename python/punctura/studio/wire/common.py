"""Parts of messages in both directions. SI, unless a key ends in another unit."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from punctura.scene.schema import Behind, Look

# JSON has no NaN and no infinity: missing numbers are left out or null.
Finite = Annotated[float, Field(allow_inf_nan=False)]
Vector = Annotated[list[Finite], Field(min_length=3, max_length=3)]
Name = Annotated[str, Field(min_length=1, max_length=80)]
Tables = dict[str, object]  # a scene file's tables, with its keys and units: docs/scene-file.md


class Part(BaseModel):
    """The base of all parts: unknown keys and wrong types are errors."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class ProblemPart(Part):
    """One problem of a scene or an exercise: where, and why. punctura.errors.Problem."""

    path: str
    value: str
    reason: str


class LawCurve(Part):
    """Phi_I and Phi_O of one membrane over the depth: K06 (18), (19). All arrays have the same length."""

    name: str
    obliquity: Finite  # rad, between the needle and the inward normal
    far_face: Finite  # m, the depth at which the tip's point is behind the membrane: U = H / cos(obliquity)
    through: Finite  # m, the depth at which the whole tip is behind the membrane: X + U
    depth: list[Finite]  # m
    lower: list[Finite]  # N, Phi_I
    upper: list[Finite]  # N, Phi_O


class MembraneView(Part):
    """One membrane as the page draws it, SI."""

    name: str
    point: Vector  # m
    inward_normal: Vector  # of length 1
    thickness: Finite  # m
    look: Look
    behind: Behind


class SyringeView(Part):
    """The syringe of a scene as the page draws it, SI."""

    bore: Finite  # m, the barrel's inner diameter
    volume: Finite  # m^3, of liquid and air at the start


class SceneView(Part):
    """A scene as the page draws it, SI; `tables` has the same scene in the file's keys and units, for the editor."""

    number: int  # index of the scene in this run, from 0
    name: str
    diameter: Finite  # m
    tip_length: Finite  # m, of the slanted face along the needle: X
    direction: str
    solver: str
    rate: Finite  # Hz, the device's
    force_scale: Finite  # how much of the model's force the device gives, before the limits; at most 1
    membranes: list[MembraneView]
    laws: list[LawCurve]
    tables: Tables
    lumen: list[int]  # indices of the two membranes with blood between them; empty without blood
    syringe: SyringeView | None = None  # on the needle, with a plunger; None: the scene has no syringe

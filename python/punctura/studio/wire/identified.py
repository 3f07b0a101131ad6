"""The lines that the studio sends while it identifies a trace: one JSON object in each line, SI units."""

from typing import Annotated, Literal

from pydantic import BaseModel, Field

from punctura.studio.wire.common import Finite, Part

Role = Literal["depth", "force", "time"]


class ColumnPart(Part):
    """A column of a file."""

    name: str
    unit: str  # that its name states, or empty
    examples: list[Finite]  # its first numbers, in the unit of the file


class RolePart(Part):
    """What must be known of a quantity. column: that is clear by its name; empty if none is."""

    role: Role
    needed: bool
    column: str
    units: list[str]  # that can be stated


class NeedlePart(Part):
    diameter: Finite  # m
    tip_angle: Finite  # rad


class FileLine(Part):
    """What a file holds. A recording of Punctura states everything, so it has no roles."""

    kind: Literal["file"] = "file"
    name: str
    rows: int
    columns: list[ColumnPart]
    roles: list[RolePart]
    needle: NeedlePart | None


class StepLine(Part):
    """The step that is computed now."""

    kind: Literal["step"] = "step"
    words: str
    share: Finite | None  # of the step that is done, 0 to 1; null if it is not known


class CurvesPart(Part):
    """Samples of a trace, thinned so that every peak stays. All lists have the same length."""

    depth: list[Finite]  # m
    force: list[Finite]  # N, positive where the tissue resists
    time: list[Finite] | None  # s
    model: list[Finite] | None  # N, of the fit


class FindingPart(Part):
    """Something unusual in the trace."""

    kind: str  # one word
    text: str


class TraceLine(Part):
    """The trace as it was read, before a fit."""

    kind: Literal["trace"] = "trace"
    name: str
    samples: int
    peak: Finite  # N, the greatest force
    contact: Finite | None  # m, depth of the first contact
    pops: list[Finite]  # m, their depths
    curves: CurvesPart
    findings: list[FindingPart]


class EstimatePart(Part):
    """A parameter and its 95 % interval; null where the trace sets no bound."""

    name: str
    value: Finite
    low: Finite | None
    high: Finite | None
    unit: str
    identifiable: bool


class TriedPart(Part):
    """A model that was tried. The criteria count independent samples."""

    membranes: int
    extensions: list[str]
    parameters: int
    rmse: Finite  # N
    held_out_rmse: Finite | None  # N, at samples that the fit did not see; None if it was not measured
    aicc: Finite | None  # None: more parameters than independent samples
    bic: Finite


class FitLine(Part):
    """The identified membranes."""

    kind: Literal["fit"] = "fit"
    membranes: int
    extensions: list[str]  # of K06
    rmse: Finite  # N
    rmse_share: Finite  # of the peak
    explained: bool  # nothing says that the model is not the whole truth
    effective_samples: Finite  # as many independent samples tell as much
    curves: CurvesPart
    estimates: list[EstimatePart]
    verdicts: list[str]  # what the trace cannot tell, and which experiment would
    tried: list[TriedPart]  # the chosen one first
    scene: str  # the text of a scene file; empty if there is none
    no_scene: str  # why there is none


class RivalRow(Part):
    """A force model on the trace. null: no value."""

    name: str
    title: str
    parameters: int
    rmse: Finite  # N
    rmse_share: Finite  # of the peak
    aic: Finite | None
    bic: Finite | None
    held_out_rmse: Finite | None  # N
    rest: Finite | None  # N, how much its force shakes while the hand rests
    converged: bool  # false: the fit ended at its limit of steps
    own: bool  # K06, not a model of other authors
    force: list[Finite]  # N, at the samples of the fit's curves


class RivalsLine(Part):
    """All models on the trace, the one with the least AIC first."""

    kind: Literal["rivals"] = "rivals"
    rows: list[RivalRow]
    notes: list[str]


class ReportLine(Part):
    """The one-page report, as the text of an HTML file."""

    kind: Literal["report"] = "report"
    html: str


class ErrorLine(Part):
    """The computation has ended without a result. field: the field of the page with the wrong value, or empty."""

    kind: Literal["error"] = "error"
    text: str
    field: str = ""  # file, column.depth, unit.depth, diameter_mm, tip_angle_deg, membranes, ...


IdentifyLine = Annotated[
    FileLine | StepLine | TraceLine | FitLine | RivalsLine | ReportLine | ErrorLine, Field(discriminator="kind")
]


class TraceJob(BaseModel):
    """A file in the present folder, and the words that the user gave for it."""

    task: Literal["look", "identify"]
    file: str
    columns: dict[str, str] = Field(default={})
    units: dict[str, str] = Field(default={})
    order: str = "recorded"
    diameter_mm: str = ""
    tip_angle_deg: str = ""
    membranes: str = "auto"

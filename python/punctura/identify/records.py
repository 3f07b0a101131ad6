"""The keys of the JSON that an identification gives: of `--json`, and of the files of a folder of traces."""

from typing import Literal, TypeAlias, TypedDict


class NeedleRecord(TypedDict):
    """The needle that made the trace."""

    diameter_m: float
    tip_angle_rad: float


class ParameterRecord(TypedDict):
    """A parameter with its 95 % interval, SI. A bound that is missing is None."""

    name: str
    value: float
    low: float | None
    high: float | None
    unit: str
    identifiable: bool


class RigRecord(TypedDict):
    """An error of the rig that was taken into account, SI. Not stated: estimated from the trace."""

    name: str
    value: float
    unit: str
    stated: bool


class FindingRecord(TypedDict):
    """Something unusual in the trace."""

    kind: str
    text: str
    repaired: bool


class ModelRecord(TypedDict):
    """A model that was tried."""

    name: str
    extensions: list[str]
    rmse_N: float
    parameters: int  # their number
    membranes: int
    aicc: float | None  # None: more parameters than independent samples
    bic: float
    held_out_rmse_N: float | None


class PlaceRecord(TypedDict):
    """A stretch that the model does not explain. force_N: measured less computed."""

    way: str  # in, out, hold
    insertion: int
    shallow_m: float
    deep_m: float
    force_N: float
    share: float  # of all that is left


class CauseRecord(TypedDict):
    """What could explain what is left, by its kind in docs/identify.md: barbs, ripple, depth ..."""

    kind: str
    share: float
    text: str


class ExplainedRecord(TypedDict):
    """Whether the model explains the trace."""

    explained: bool
    left_N: float
    noise_N: float
    noise_is_of_air: bool
    runs: int
    runs_of_noise: float
    not_explained: list[PlaceRecord]
    causes: list[CauseRecord]


class IdentificationRecord(TypedDict):
    """A whole identification."""

    trace: str
    samples: int
    effective_samples: float
    membranes: int
    extensions: list[str]
    rmse_N: float
    rmse_share_of_peak: float
    held_out_rmse_N: float | None
    needle: NeedleRecord
    parameters: list[ParameterRecord]
    correlations: list[list[float]]
    rig: list[RigRecord]
    findings: list[FindingRecord]
    explained: ExplainedRecord
    verdicts: list[str]
    models: list[ModelRecord]


class TaskRecord(TypedDict):
    """What the result of a trace depends on, beside its file."""

    needle: list[float]
    membranes: int | Literal["auto"]
    reading: dict[str, object]  # trace/reading.py
    rig: dict[str, float | None]  # rig.py
    punctura: str  # version


class IdentifiedRecord(IdentificationRecord):
    """The file of a trace in a folder of results."""

    task: TaskRecord
    stamp: list[int]  # size and time of the trace's file
    error: None


class FailedRecord(TypedDict):
    """The file of a trace that could not be read or fitted."""

    task: TaskRecord
    stamp: list[int]
    error: str
    trace: str
    parameters: list[ParameterRecord]  # empty


TraceRecord: TypeAlias = IdentifiedRecord | FailedRecord


class TraceRow(ParameterRecord):
    """A row of traces.parquet."""

    trace: str
    rmse_N: float
    membranes: int
    extensions: str


class PopulationRow(TypedDict):
    """A row of population.parquet: a parameter over all traces."""

    name: str
    unit: str
    traces: int
    mean: float
    low: float
    high: float
    spread: float
    spread_is_relative: bool
    shrinkage: float


class FolderRecord(TypedDict):
    """The summary of a folder."""

    traces: int
    identified: int
    kept: int
    failed: dict[str, str]  # the reason by the name of the trace
    population: list[PopulationRow]

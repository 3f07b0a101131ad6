"""Schema of a recording's description (its header), checked once when the file is opened.

Each header field has a line here. Unknown keys are kept unchanged, because another version may have written them.
"""

import json
import math
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from punctura._core import PuncturaError
from punctura.errors import NoSuchFileError
from punctura.results import JsonObject


class RecordingError(PuncturaError, ValueError):
    """A recording cannot be started, read or replayed. Names the file, the problem and the remedy."""


class MissingRecordingError(RecordingError, NoSuchFileError):
    """There is no file at a recording's path."""


# Formats that this version reads. In format 1 the gate limited the distance between two readings, and `spent_N2s` did
# not exist. Only a run with rivals has format 3: a version that does not know them must not replay it with K06's law.
FORMATS = (1, 2, 3)
_MOST_NESTED = 64
_MOST_PROBLEMS = 5  # in one message

Count = Annotated[int, Field(ge=0, lt=2**63)]
Tick = Annotated[int, Field(ge=-1, lt=2**63)]  # -1: no tick
Positive = Annotated[float, Field(gt=0, le=1e9)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Number = Annotated[float, Field(allow_inf_nan=False)]
Whole = Annotated[int, Field(ge=-(2**63), lt=2**63)]
Value = Whole | Number | Literal["nan", "inf", "-inf"]  # words for values that JSON cannot represent as numbers


class _Part(BaseModel):
    model_config = ConfigDict(strict=True, extra="allow", frozen=True)

    def __getitem__(self, name: str) -> Any:
        if name not in type(self).model_fields and name not in (self.model_extra or {}):
            raise KeyError(name)
        return getattr(self, name)


class DeviceBefore(_Part):
    """The device's DeviceInfo from before the run."""

    backend: str = ""
    model: str = ""
    serial: str = ""
    has_orientation: bool = False
    button_count: Count = 0
    rate: Value = "nan"
    max_force: Value = "nan"
    continuous_force: Value = "nan"
    max_stiffness: Value = "nan"
    encoder_step: Value = "nan"


class DeviceAfter(_Part):
    """The device's report after the run."""

    statements: list[str] = []
    trouble: str = ""


class SecondDevice(_Part):
    """The device under the thumb."""

    device: DeviceBefore = DeviceBefore()
    limits: dict[str, Value] = {}


class RivalNumbers(_Part):
    """A force model in place of the scene's law, with its numbers (SI)."""

    rival: str
    numbers: dict[str, Number]


class FaultAt(_Part):
    """A fault and its tick: `fault.tick` or `fault["tick"]`."""

    tick: Count
    fault: str
    meaning: str


class Summary(_Part):
    """Summary of a recording: `summary.lost` or `summary["lost"]`."""

    ticks: Count = 0
    first_tick: Tick = -1
    last_tick: Tick = -1
    lost: Count = 0
    new_scenes: Count = 0
    fault_count: Count = 0
    faults: list[FaultAt] = []
    notes: list[str] = []
    damaged: bool = False


class Description(_Part):
    """The header of a recording."""

    format: int
    build: str
    machine: str = ""
    began: str = ""
    began_ns: Count
    rate_hz: Positive
    period_s: Positive
    device: DeviceBefore
    gate: dict[str, Value]
    limits: dict[str, Value]
    spent_N2s: NotNegative = 0.0
    scene: str
    libraries: dict[str, str] = {}
    about: JsonObject = {}
    summary: Summary = Summary()
    lost: dict[str, Count] = {}
    device_after: DeviceAfter = DeviceAfter()
    second_device: SecondDevice | None = None
    rivals: list[RivalNumbers] = []
    replayed_from: str = ""
    replayed_by: str = ""


def read_description(text: bytes, path: Path) -> tuple[JsonObject, Description]:
    """The JSON object as stored, and the checked description.

    Raises RecordingError, which names the file and each invalid field.
    """
    data = _json(text, path)
    if data.get("format") not in FORMATS or isinstance(data["format"], bool):
        known = ", ".join(str(number) for number in FORMATS)
        raise RecordingError(
            f"{path} has format {_brief(data.get('format'))}; this version of Punctura reads the formats {known}. "
            f"Use the version that wrote it: {_brief(data.get('build', 'unknown'))}"
        )
    try:
        return data, Description.model_validate(data)
    except ValidationError as bad:
        raise RecordingError(f"{path}: the run description is invalid: {_problems_of(bad)}") from None


def _json(text: bytes, path: Path) -> JsonObject:
    try:
        data = json.loads(text.decode(), parse_float=_finite, parse_constant=_finite)
        json.dumps(data, ensure_ascii=False).encode()  # fails for a lone surrogate, which can be read but not written
    except (ValueError, RecursionError) as bad:
        raise RecordingError(f"{path}: the run description is invalid: it is not JSON ({bad})") from None
    if not isinstance(data, dict):
        raise RecordingError(f"{path}: the run description is invalid: it is not a JSON object")
    if _nested(data) > _MOST_NESTED:
        raise RecordingError(f"{path}: the run description is invalid: it is nested too deeply")
    return data


def _finite(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"{text} is not a finite number")
    return value


def _nested(value: Any) -> int:
    depth, level = 0, [value]
    while level and depth <= _MOST_NESTED:
        inner = [v.values() if isinstance(v, dict) else v for v in level if isinstance(v, dict | list)]
        level = [child for children in inner for child in children]
        depth += 1
    return depth


def _problems_of(error: ValidationError) -> str:
    problems = []
    for one in error.errors(include_url=False)[:_MOST_PROBLEMS]:
        where = ".".join(str(part) for part in one["loc"])
        given = "" if one["type"] == "missing" else f" = {_brief(one['input'])}"
        problems.append(f"{where}{given}: {one['msg'][:1].lower()}{one['msg'][1:]}")
    more = error.error_count() - len(problems)
    return "; ".join(problems) + (f"; and {more} more" if more else "")


def _brief(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 80 else f"{text[:70]} ..."

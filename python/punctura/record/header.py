"""What a recording says of its run: JSON in the file's metadata, completed when it is finished."""

from __future__ import annotations

import datetime
import json
import math
import time
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import pyarrow as pa

from punctura._core import Device, ForceLimits, GateLimits, Scene, ServoLoop
from punctura.record.build_id import build_id, machine
from punctura.record.description import FORMATS, Description, read_description
from punctura.record.errors import RecordingError
from punctura.record.scene_text import from_text, to_text
from punctura.record.schema import check_columns

T = TypeVar("T")

FORMAT = FORMATS[-1]
KEY, CHECK = b"punctura.recording", b"punctura.crc32"


def describe_run(loop: ServoLoop) -> dict[str, Any]:
    """What is known when a recording begins."""
    rate = loop.scene.servo.rate
    now_ns = time.time_ns()
    return {
        "format": FORMAT,
        "build": build_id(),
        "machine": machine(),
        "began": datetime.datetime.fromtimestamp(now_ns / 1e9, datetime.timezone.utc).isoformat(),
        "began_ns": now_ns,
        "rate_hz": rate,
        "period_s": 1 / rate,
        "device": _fields(loop.device.info),
        "gate": _fields(loop.gate),
        "limits": _fields(loop.limits),
        "spent_N2s": loop.spent,
        "scene": to_text(loop.scene, rate),
        "libraries": {"pyarrow": pa.__version__, "numpy": np.__version__},
    }


def describe_device(device: Device) -> dict[str, Any]:
    """What a device has to say after a run."""
    return {"statements": list(device.statements()), "trouble": device.trouble()}


def _fields(struct: object) -> dict[str, Any]:
    """The values of a plain struct. What JSON has no number for is written as a word: "nan", "inf"."""
    names = [name for name in dir(struct) if not name.startswith("_") and not callable(getattr(struct, name))]
    return {name: _plain(getattr(struct, name)) for name in names}


def _plain(value: Any) -> Any:
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


class RecordingInfo:
    """The description of a recorded run. `data` is all of it as JSON has it; `said` the same, checked and typed."""

    def __init__(self, data: dict[str, Any], said: Description, path: Path) -> None:
        self.data, self.said = data, said
        self._path = path

    @property
    def scene(self) -> Scene:
        """The one that the run began with, at the device's rate. Raises RecordingError."""
        return from_text(self.said.scene, self._path)

    @property
    def gate(self) -> GateLimits:
        """Raises RecordingError."""
        values = dict(self.said.gate)
        if "position_jump" in values:  # format 1: m from one reading to the next
            values["max_speed"] = _number(values.pop("position_jump")) * self.said.rate_hz
        return self._struct(GateLimits, "gate", values)

    @property
    def limits(self) -> ForceLimits:
        """As they acted, with the device's ratings. Raises RecordingError."""
        return self._struct(ForceLimits, "limits", self.said.limits)

    @property
    def spent(self) -> float:
        """What the device's motors had given before the run, N^2 s: with it the limits act again as they did."""
        return self.said.spent_N2s

    @property
    def build(self) -> str:
        return self.said.build

    @property
    def about(self) -> dict[str, Any]:
        """What else its maker had to say; empty if nothing."""
        return self.said.about

    @property
    def began_ns(self) -> int:
        """Of the clock on the wall, ns since 1970."""
        return self.said.began_ns

    def _struct(self, kind: Callable[..., T], name: str, values: dict[str, Any]) -> T:
        try:
            return kind(**{key: _number(value) for key, value in values.items()})
        except TypeError:
            reason = f"it holds {', '.join(values)}, not all of which this version knows, or with another type"
        except ValueError as bad:
            reason = " ".join(str(bad).split())
        raise RecordingError(f"{self._path}: {name} in the description of the run cannot be used: {reason}")


def _number(value: Any) -> Any:
    """The number that a word stands for; see _plain."""
    return float(value) if isinstance(value, str) else value


def to_metadata(data: dict[str, Any], schema: pa.Schema) -> dict[bytes, bytes]:
    """For a schema's metadata, with a check sum over description and columns."""
    return with_check_sum(json.dumps(data, ensure_ascii=False).encode(), schema)


def with_check_sum(text: bytes, schema: pa.Schema) -> dict[bytes, bytes]:
    """The metadata of a schema whose description is this text."""
    return {KEY: text, CHECK: str(_check(text, schema)).encode()}


def from_metadata(schema: pa.Schema, path: Path) -> RecordingInfo:
    """Raises RecordingError where a file is no recording, or its description is damaged."""
    text = (schema.metadata or {}).get(KEY)
    if text is None:
        raise RecordingError(f"{path} is not a recording of Punctura")
    if not is_sound(schema):
        raise RecordingError(f"{path} is damaged: the description of the run is not as it was written")
    check_columns(schema, path)
    return RecordingInfo(*read_description(text, path), path)


def is_sound(schema: pa.Schema) -> bool:
    """Whether description and columns are as they were written."""
    metadata = schema.metadata or {}
    try:
        return KEY in metadata and metadata.get(CHECK) == str(_check(metadata[KEY], schema)).encode()
    except UnicodeDecodeError:  # a column's name
        return False


def _check(text: bytes, schema: pa.Schema) -> int:
    # Parquet has another name for what is in a list.
    columns = "\n".join(f"{f.name} {f.type}".replace("<element:", "<item:") for f in schema)
    return zlib.crc32(columns.encode(), zlib.crc32(text))

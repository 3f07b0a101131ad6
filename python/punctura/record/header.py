"""What a recording says of its run: JSON in the file's metadata, completed when it is finished."""

from __future__ import annotations

import datetime
import json
import math
import time
import zlib
from pathlib import Path
from typing import Any, cast

import numpy as np
import pyarrow as pa

from punctura._core import Device, ForceLimits, GateLimits, Scene, ServoLoop
from punctura.record.build_id import build_id, machine
from punctura.record.errors import RecordingError
from punctura.record.scene_text import from_text, to_text

FORMAT = 2
READABLE = (1, 2)  # 1 had the gate's limit on motion as a distance from one reading to the next, and no `spent_N2s`
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
    """The description of a recorded run. `data` is all of it, as JSON has it."""

    def __init__(self, data: dict[str, Any], path: Path) -> None:
        self.data = data
        self._path = path

    @property
    def scene(self) -> Scene:
        """The one that the run began with, at the device's rate."""
        return from_text(self._need("scene", str), self._path)

    @property
    def gate(self) -> GateLimits:
        values = self._limits("gate")
        if "position_jump" in values:  # format 1: m from one reading to the next
            values["max_speed"] = values.pop("position_jump") * float(self._need("rate_hz", float))
        return GateLimits(**values)

    @property
    def limits(self) -> ForceLimits:
        """As they acted, with the device's ratings."""
        return ForceLimits(**self._limits("limits"))

    @property
    def spent(self) -> float:
        """What the device's motors had given before the run, N^2 s: with it the limits act again as they did."""
        return float(self.data.get("spent_N2s", 0.0))

    @property
    def build(self) -> str:
        return cast(str, self._need("build", str))

    @property
    def about(self) -> dict[str, Any]:
        """What else its maker had to say; empty if nothing."""
        about = self.data.get("about", {})
        return about if isinstance(about, dict) else {}

    @property
    def began_ns(self) -> int:
        """Of the clock on the wall, ns since 1970."""
        return cast(int, self._need("began_ns", int))

    def _limits(self, name: str) -> dict[str, Any]:
        values = self._need(name, dict)
        return {key: float(value) if isinstance(value, str) else value for key, value in values.items()}

    def _need(self, name: str, kind: type) -> Any:
        value = self.data.get(name)
        if not isinstance(value, kind):
            raise RecordingError(f"{self._path}: the recording does not say its {name}")
        return value


def to_metadata(data: dict[str, Any], schema: pa.Schema) -> dict[bytes, bytes]:
    """For a schema's metadata, with a check sum over description and columns."""
    text = json.dumps(data, ensure_ascii=False).encode()
    return {KEY: text, CHECK: str(_check(text, schema)).encode()}


def from_metadata(schema: pa.Schema, path: Path) -> RecordingInfo:
    """Raises RecordingError where a file is no recording, or its description is damaged."""
    text = (schema.metadata or {}).get(KEY)
    if text is None:
        raise RecordingError(f"{path} is not a recording of Punctura")
    if not is_sound(schema):
        raise RecordingError(f"{path} is damaged: the description of the run is not as it was written")
    data = json.loads(text)
    if data.get("format") not in READABLE:
        raise RecordingError(
            f"{path} has format {data.get('format')!r}, and this Punctura reads {' and '.join(map(str, READABLE))}; "
            f"use the one that wrote it: {data.get('build', 'unknown')}"
        )
    return RecordingInfo(data, path)


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

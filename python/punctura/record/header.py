"""The description of a run: JSON in the file's metadata, completed when the recording is finished."""

import datetime
import hashlib
import json
import math
import platform
import time
import zlib
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import pyarrow as pa

from punctura import _core
from punctura._core import Device, ForceLimits, GateLimits, Rival, Scene, ServoLoop, ThumbLoop
from punctura.device_words import statements_of, words_of
from punctura.errors import ConfigurationError
from punctura.files.toml import parse_toml
from punctura.record.columns import check_columns
from punctura.record.description import (
    FORMATS,
    Description,
    DeviceAfter,
    DeviceBefore,
    RecordingError,
    RivalNumbers,
    SecondDevice,
    Value,
    read_description,
)
from punctura.results import JsonObject
from punctura.scene import scene_text
from punctura.scene.build import build_scene
from punctura.scene.check import check_tables


@cache
def build_id() -> str:
    """Version, compiler, and a digest of the compiled core. Builds with equal ids compute the same results."""
    digest = hashlib.sha256(Path(_core.__file__).read_bytes()).hexdigest()[:16]
    return f"punctura {_core.version()}; {_core.compiler()}; core {digest}"


def machine() -> str:
    """System and processor. A math library may select its code by them, which can change results."""
    return f"{platform.system()} {platform.release()} {platform.machine()} {'-'.join(platform.libc_ver())}".strip()


def to_text(scene: Scene, rate: float) -> str:
    """The text of the scene at the device's rate (Hz)."""
    return scene_text(scene.replace(servo=scene.servo.replace(rate=rate)))


def from_text(text: str, path: Path) -> Scene:
    """The scene of a text. Raises RecordingError."""
    try:
        scene_file, problems = check_tables(parse_toml(text, path))
        if scene_file is None:
            raise ConfigurationError(problems, str(path))
        return build_scene(scene_file)
    except ConfigurationError as bad:
        raise RecordingError(f"{path}: a scene in the recording is invalid: {bad}") from None


T = TypeVar("T")

FORMAT, FORMAT_WITH_RIVALS = FORMATS[-2:]
KEY, CHECK = b"punctura.recording", b"punctura.crc32"


def describe_run(loop: ServoLoop, about: JsonObject | None = None, thumb: ThumbLoop | None = None) -> JsonObject:
    """The description as known when a recording begins."""
    rate = loop.scene.servo.rate
    now_ns = time.time_ns()
    more: JsonObject = {"about": about} if about else {}
    if thumb is not None:
        second = SecondDevice(device=DeviceBefore(**_fields(thumb.device.info)), limits=_fields(thumb.limits))
        more["second_device"] = second
    if loop.rivals:
        more["rivals"] = [RivalNumbers(rival=rival.name, numbers=rival.numbers) for rival in loop.rivals]
    return Description(
        format=FORMAT_WITH_RIVALS if loop.rivals else FORMAT,
        build=build_id(),
        machine=machine(),
        began=datetime.datetime.fromtimestamp(now_ns / 1e9, datetime.timezone.utc).isoformat(),
        began_ns=now_ns,
        rate_hz=rate,
        period_s=1 / rate,
        device=DeviceBefore(**_fields(loop.device.info)),
        gate=_fields(loop.gate),
        limits=_fields(loop.limits),
        spent_N2s=loop.spent,
        scene=to_text(loop.scene, rate),
        libraries={"pyarrow": pa.__version__, "numpy": np.__version__},
        **more,
    ).model_dump(exclude_unset=True)


def describe_device(device: Device, thumb: ThumbLoop | None = None) -> DeviceAfter:
    """The report of the device after a run, and of the second device."""
    troubles = [device.trouble()]
    if thumb is not None:
        troubles += [f"second device: {text}" for text in (words_of(thumb), thumb.device.trouble()) if text]
    return DeviceAfter(statements=statements_of(device, thumb), trouble="; ".join(filter(None, troubles)))


def _fields(struct: object) -> dict[str, Any]:
    """The values of a plain struct. Values that are not JSON numbers become words: "nan", "inf"."""
    names = [name for name in dir(struct) if not name.startswith("_") and not callable(getattr(struct, name))]
    return {name: _plain(getattr(struct, name)) for name in names}


def _plain(value: Any) -> Any:
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


class RecordingInfo:
    """The description of a recorded run. `data` is its JSON object; `header` the same, checked and typed."""

    def __init__(self, data: JsonObject, header: Description, path: Path) -> None:
        self.data, self.header = data, header
        self._path = path

    @property
    def scene(self) -> Scene:
        """The scene at the start of the run, at the device's rate. Raises RecordingError."""
        return from_text(self.header.scene, self._path)

    @property
    def gate(self) -> GateLimits:
        """The limits of the input gate. Raises RecordingError."""
        values = dict(self.header.gate)
        if "position_jump" in values:  # format 1: m between two readings
            values["max_speed"] = _number(values.pop("position_jump")) * self.header.rate_hz
        return self._struct(GateLimits, "gate", values)

    @property
    def limits(self) -> ForceLimits:
        """The force limits in effect, device ratings included. Raises RecordingError."""
        return self._struct(ForceLimits, "limits", self.header.limits)

    @property
    def spent(self) -> float:
        """Motor load at the start of the run, N^2 s. A replay needs it to limit the force as the run did."""
        return self.header.spent_N2s

    @property
    def rivals(self) -> list[Rival]:
        """The force models in place of the scene's law; empty if there were none. Raises RecordingError."""
        try:
            return [Rival(one.rival, one.numbers) for one in self.header.rivals]
        except ValueError as bad:
            reason = " ".join(str(bad).split())
        raise RecordingError(f"{self._path}: a rival in the run description is invalid: {reason}")

    @property
    def build(self) -> str:
        return self.header.build

    @property
    def about(self) -> JsonObject:
        """Further data from the caller of Recorder; empty if none."""
        return self.header.about

    @property
    def began_ns(self) -> int:
        """Start of the recording, ns since 1970 by the wall clock."""
        return self.header.began_ns

    def _struct(self, kind: Callable[..., T], name: str, values: Mapping[str, Value]) -> T:
        try:
            return kind(**{key: _number(value) for key, value in values.items()})
        except TypeError:
            reason = f"it holds {', '.join(values)}; this version lacks some of these keys, or a value has a wrong type"
        except ValueError as bad:
            reason = " ".join(str(bad).split())
        raise RecordingError(f"{self._path}: {name} in the run description is invalid: {reason}")


def _number(value: Value) -> float:
    """The inverse of _plain: a number from its word."""
    return float(value) if isinstance(value, str) else value


def to_metadata(data: Mapping[str, object], schema: pa.Schema) -> dict[bytes, bytes]:
    """Schema metadata with a checksum over description and columns."""
    return with_check_sum(json.dumps(data, ensure_ascii=False).encode(), schema)


def with_check_sum(text: bytes, schema: pa.Schema) -> dict[bytes, bytes]:
    """Schema metadata for this description text."""
    return {KEY: text, CHECK: str(_check(text, schema)).encode()}


def from_metadata(schema: pa.Schema, path: Path) -> RecordingInfo:
    """Reads the description. Raises RecordingError if the file is not a recording or its description is damaged."""
    text = (schema.metadata or {}).get(KEY)
    if text is None:
        raise RecordingError(f"{path} is not a recording of Punctura")
    if not is_sound(schema):
        raise RecordingError(f"{path} is damaged: the checksum of the run description is wrong")
    check_columns(schema, path)
    return RecordingInfo(*read_description(text, path), path)


def is_sound(schema: pa.Schema) -> bool:
    """Whether the checksum of description and columns is right."""
    metadata = schema.metadata or {}
    try:
        return KEY in metadata and metadata.get(CHECK) == str(_check(metadata[KEY], schema)).encode()
    except UnicodeDecodeError:  # in a column name
        return False


def _check(text: bytes, schema: pa.Schema) -> int:
    # Arrow and Parquet name the element type of a list differently.
    columns = "\n".join(f"{f.name} {f.type}".replace("<element:", "<item:") for f in schema)
    return zlib.crc32(columns.encode(), zlib.crc32(text))

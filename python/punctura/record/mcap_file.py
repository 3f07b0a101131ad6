"""Exports to MCAP for robotics viewers: one JSON message per tick, with a JSON Schema. Needs the package `mcap`."""

import json
import math
from collections.abc import Iterator, Mapping
from typing import Any

import pyarrow as pa

from punctura.extras import optional
from punctura.progress import Report
from punctura.record.columns import NEW_SCENES, in_pieces
from punctura.record.recording import Recording
from punctura.ticks.arrow import words_of

TICKS, SCENES = "punctura/tick", "punctura/scene"

_SCENE_SCHEMA = {
    "type": "object",
    "properties": {"tick": {"type": "integer"}, "toml": {"type": "string", "description": "the scene file"}},
}


def mcap_steps(recording: Recording, out: Any, progress: Report | None = None) -> Iterator[None]:
    """Writes ticks to topic punctura/tick and scenes to punctura/scene, batch by batch, to an open file.

    Raises ModuleNotFoundError if the package is missing.
    """
    writer = optional("mcap.writer", "mcap", "an MCAP file").Writer
    yield from _Messages(writer(out), recording).steps(progress)


class _Messages:
    def __init__(self, writer: Any, recording: Recording) -> None:
        self._writer, self._recording = writer, recording
        self._stamp = self._began = recording.info.began_ns
        self._first_time: float | None = None

    def steps(self, progress: Report | None) -> Iterator[None]:
        writer, recording = self._writer, self._recording
        writer.start(profile="", library=recording.info.build)
        writer.add_metadata("punctura.recording", {"json": json.dumps(recording.info.data)})
        ticks = self._channel(TICKS, "punctura.Tick", _tick_schema(recording.schema))
        scenes = self._channel(SCENES, "punctura.Scene", _SCENE_SCHEMA)
        self._message(scenes, 0, {"tick": 0, "toml": recording.info.header.scene})
        for batch in in_pieces(recording.batches(progress)):
            for row in batch.to_pylist():
                tick, taken = row["tick"], row.pop(NEW_SCENES) or []
                self._advance(row["time_s"])
                for toml in taken:
                    self._message(scenes, tick, {"tick": tick, "toml": toml})
                self._message(ticks, tick, {name: _plain(value) for name, value in row.items()})
            yield
        writer.finish()

    def _channel(self, topic: str, name: str, schema: Mapping[str, object]) -> int:
        made = self._writer.register_schema(name=name, encoding="jsonschema", data=json.dumps(schema).encode())
        return int(self._writer.register_channel(topic=topic, message_encoding="json", schema_id=made))

    def _advance(self, time_s: float) -> None:
        """Sets the wall-clock time stamp of the tick. If time_s is not finite, keeps the previous stamp."""
        if self._first_time is None and math.isfinite(time_s):
            self._first_time = time_s
        stamp = self._began + (time_s - (self._first_time or 0.0)) * 1e9
        if math.isfinite(stamp) and 0 <= stamp < 2**63:
            self._stamp = int(stamp)

    def _message(self, channel: int, tick: int, content: Mapping[str, object]) -> None:
        data = json.dumps(content, allow_nan=False, separators=(",", ":")).encode()
        self._writer.add_message(
            channel, log_time=self._stamp, publish_time=self._stamp, sequence=tick & 0xFFFFFFFF, data=data
        )


def _plain(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _tick_schema(schema: pa.Schema) -> dict[str, object]:
    return {
        "type": "object",
        "properties": {f.name: _json_type(f) for f in schema if f.name != NEW_SCENES},
    }


def _json_type(field: pa.Field) -> dict[str, object]:
    words = words_of(field.name)
    if words is not None:
        return {"type": ["string", "null"], "enum": [*words, None]}
    if pa.types.is_boolean(field.type):
        return {"type": "boolean"}
    return {"type": "integer"} if pa.types.is_integer(field.type) else {"type": ["number", "null"]}

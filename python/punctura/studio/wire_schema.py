"""All that goes between studio and page as JSON Schema, of which its types are made: `python -m` runs this module."""

from __future__ import annotations

import json
from typing import Any

from pydantic import TypeAdapter
from pydantic.json_schema import JsonSchemaValue

from punctura.compare.worker import LabLine
from punctura.exercise import Result
from punctura.studio.catalog import ExerciseOverview, SceneOutline
from punctura.studio.lab import SceneField
from punctura.studio.recorded import RecordingOverview, RecordingTrace
from punctura.studio.shelf import RecordingEntry
from punctura.studio.wire.identified import IdentifyLine
from punctura.studio.wire.messages import Message
from punctura.studio.wire.requests import Request

Answer = RecordingEntry | RecordingOverview | RecordingTrace | ExerciseOverview | SceneOutline | Result | SceneField
UNIONS: dict[str, Any] = {
    "message": Message,
    "request": Request,
    "identify_line": IdentifyLine,
    "lab_line": LabLine,
    "answer": Answer,
}


def wire_schema() -> JsonSchemaValue:
    """JSON Schema (2020-12) with a definition for each of the studio's messages, lines and answers, and for each
    request; `kind` and `do` tell messages and requests apart."""
    definitions: dict[str, JsonSchemaValue] = {}
    unions: dict[str, JsonSchemaValue] = {}
    for name, union in UNIONS.items():
        sent = name != "request"
        schema = TypeAdapter(union).json_schema(mode="serialization" if sent else "validation")
        for definition in schema["$defs"].values():
            required = set(definition.get("required", []))
            for key, entry in definition.get("properties", {}).items():
                entry.pop("title", None)  # it only repeats the key
                if sent or "const" in entry:  # the studio leaves nothing out, nor a page what tells requests apart
                    required.add(key)
            definition["required"] = [key for key in definition.get("properties", {}) if key in required]
        definitions |= schema.pop("$defs")
        unions[name] = _union(schema)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Wire",
        "type": "object",
        "additionalProperties": False,
        "required": list(unions),
        "properties": {name: {"title": name.title().replace("_", ""), **union} for name, union in unions.items()},
        "$defs": definitions,
    }


def _union(schema: JsonSchemaValue) -> JsonSchemaValue:
    parts: list[JsonSchemaValue] = []
    for entry in schema.get("oneOf") or schema["anyOf"]:
        parts += _union(entry)["oneOf"] if "$ref" not in entry else [entry]
    return {"oneOf": parts}


if __name__ == "__main__":
    print(json.dumps(wire_schema(), indent=2))

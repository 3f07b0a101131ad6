"""The messages as JSON Schema, from which the page's types are made: python -m punctura.studio.wire.schema."""

from __future__ import annotations

import json

from pydantic import TypeAdapter
from pydantic.json_schema import JsonSchemaValue

from punctura.studio.wire.identified import IdentifyLine
from punctura.studio.wire.messages import Message
from punctura.studio.wire.requests import Request, Target


def wire_schema() -> JsonSchemaValue:
    """JSON Schema (2020-12) with a definition for every message and request; `kind` and `do` tell them apart."""
    sent = TypeAdapter(Message).json_schema(mode="serialization", ref_template="#/$defs/{model}")
    asked = TypeAdapter(Request | Target).json_schema(ref_template="#/$defs/{model}")
    lines = TypeAdapter(IdentifyLine).json_schema(mode="serialization", ref_template="#/$defs/{model}")
    definitions = {**asked.pop("$defs"), **sent.pop("$defs"), **lines.pop("$defs")}
    for definition in definitions.values():
        for key, entry in definition.get("properties", {}).items():
            entry.pop("title", None)  # it only repeats the key
            if "const" in entry:  # what tells messages apart is always there
                definition.setdefault("required", []).append(key)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Wire",
        "type": "object",
        "additionalProperties": False,
        "required": ["message", "request", "identify_line"],
        "properties": {
            "message": {"title": "Message", **_union(sent)},
            "request": {"title": "Request", **_union(asked)},
            "identify_line": {"title": "IdentifyLine", **_union(lines)},
        },
        "$defs": definitions,
    }


def _union(schema: JsonSchemaValue) -> JsonSchemaValue:
    parts: list[JsonSchemaValue] = []
    for entry in schema.get("oneOf") or schema["anyOf"]:
        parts += _union(entry)["oneOf"] if "$ref" not in entry else [entry]
    return {"oneOf": parts}


if __name__ == "__main__":
    print(json.dumps(wire_schema(), indent=2))

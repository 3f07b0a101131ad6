"""All that goes between studio and page as JSON Schema, and as TypeScript: `python -m`, --typescript."""

import json
import sys
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


WORDS = {"string": "string", "number": "number", "integer": "number", "boolean": "boolean", "null": "null"}


def typescript() -> str:
    """The types of the page: an interface for each definition of the schema, a type for each union."""
    schema = wire_schema()
    parts = ["// Made by npm run types, from the models of python/punctura/studio/wire_schema.py."]
    parts += [f"export type {one['title']} = {_type_of(one)};" for one in schema["properties"].values()]
    for name, definition in schema["$defs"].items():
        required = definition["required"]
        words = definition.get("description", "")
        parts += [*(f"// {line}".rstrip() for line in words.split("\n") if words), f"export interface {name} {{"]
        for key, entry in definition.get("properties", {}).items():
            parts.append(f"  {key}{'' if key in required else '?'}: {_type_of(entry)};")
        parts.append("}")
    return "\n".join(parts)


def _type_of(schema: JsonSchemaValue) -> str:
    if "$ref" in schema:
        return str(schema["$ref"]).rsplit("/", 1)[1]
    for union in ("anyOf", "oneOf"):
        if union in schema:
            return " | ".join(map(_type_of, schema[union]))
    if "const" in schema or "enum" in schema:
        return " | ".join(json.dumps(value) for value in schema.get("enum", [schema.get("const")]))
    if schema["type"] == "array":
        item = _type_of(schema["items"])
        if schema.get("minItems") and schema.get("minItems") == schema.get("maxItems"):
            return f"[{', '.join([item] * schema['minItems'])}]"
        return f"({item})[]" if " " in item else f"{item}[]"
    if schema["type"] == "object":
        values = schema.get("additionalProperties", True)
        return f"Record<string, {'unknown' if values is True else _type_of(values)}>"
    return WORDS[schema["type"]]


if __name__ == "__main__":
    print(typescript() if "--typescript" in sys.argv else json.dumps(wire_schema(), indent=2))

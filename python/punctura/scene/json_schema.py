"""JSON Schema of scene files, for editors and forms. Bounds and defaults come from the core."""

from __future__ import annotations

import math
from decimal import Decimal

from pydantic.json_schema import JsonSchemaValue

from punctura._core import SceneKey, gauge_diameters
from punctura.files.units import split_key, to_si
from punctura.scene.schema import ALTERNATIVES, KEYS, MODELS, SceneFile, in_file


def scene_json_schema() -> JsonSchemaValue:
    """JSON Schema (2020-12) of a scene file.

    Keys of Punctura: `x-unit` is the unit of a number, `x-symbol` its letter in K06, `x-diameters-mm` the diameters of
    the gauges in `enum`, in the same order. `x-optional` marks a table that a scene may lack.
    """
    schema = SceneFile.model_json_schema()
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    for name, model in MODELS.items():
        properties = schema["$defs"][model.__name__]["properties"]
        for key in KEYS[name]:
            _complete(properties[key.key], key)
    needle = schema["$defs"]["NeedleTable"]
    gauge, diameter = needle["properties"]["gauge"], KEYS["needle"][0]
    gauge["enum"] = list(gauge_diameters())
    gauge["x-diameters-mm"] = [float(in_file(diameter, value)) for value in gauge_diameters().values()]
    needle["allOf"] = [{"oneOf": [{"required": [key]} for key in pair]} for pair in ALTERNATIVES]
    schema["properties"]["membrane"]["minItems"] = 1
    syringe = schema["properties"]["syringe"]
    schema["properties"]["syringe"] = {"$ref": syringe["anyOf"][0]["$ref"], "x-optional": True}
    return schema


def _complete(entry: JsonSchemaValue, key: SceneKey) -> None:
    kinds = entry.pop("anyOf", [])
    if any(kind.get("type") == "null" for kind in kinds):  # the key is optional, but never null
        entry |= next(kind for kind in kinds if kind.get("type") != "null")
        entry.pop("default", None)
    elif kinds:  # a number or a word
        entry["anyOf"] = kinds
    list_of = entry.get("items", {}) if entry.get("type") == "array" else {}
    number = next((kind for kind in (entry, *kinds, list_of) if kind.get("type") == "number"), None)
    if number is not None and "default" in entry:
        entry["default"] = list(entry["default"]) if number is list_of else float(entry["default"])
    unit = split_key(key.key)[1]
    if unit.name:
        entry["x-unit"] = unit.name
    if number is None or key.kind == "vector":
        return
    for bound, is_open, closed_name, open_name in (
        (key.min, key.min_open, "minimum", "exclusiveMinimum"),
        (key.max, key.max_open, "maximum", "exclusiveMaximum"),
    ):
        if math.isfinite(bound):
            number[open_name if is_open else closed_name] = bound / to_si(Decimal(1), unit)
    entry["x-reason"] = key.reason

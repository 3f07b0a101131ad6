"""JSON Schema of scene files, for editors and forms. Bounds and defaults come from the core."""

from __future__ import annotations

import math
from decimal import Decimal

from pydantic.json_schema import JsonSchemaValue

from punctura import _core
from punctura.files.units import split_key, to_si
from punctura.results import FieldBounds
from punctura.scene.gauges import GAUGE_DIAMETER_MM
from punctura.scene.schema import ALTERNATIVES, SceneFile

_TABLE_OF = {
    "NeedleTable": "needle", "CouplingTable": "coupling", "ServoTable": "servo", "DisplayTable": "display",
    "SyringeTable": "syringe", "MembraneTable": "membrane",
}  # fmt: skip


def scene_json_schema() -> JsonSchemaValue:
    """JSON Schema (2020-12) of a scene file. `x-unit` is a number's unit, `x-symbol` its letter in K06, and
    `x-diameters-mm` the diameters of the gauges, in the order of `enum`, `x-optional` a table that a scene may lack."""
    schema = SceneFile.model_json_schema()
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    fields = {field["path"]: field for field in _core.fields()}
    for model, table in _TABLE_OF.items():
        properties = schema["$defs"][model]["properties"]
        for key, entry in properties.items():
            _complete(entry, key, fields.get(f"{table}.{split_key(key)[0]}"))
    needle = schema["$defs"]["NeedleTable"]
    needle["properties"]["gauge"]["enum"] = list(GAUGE_DIAMETER_MM)
    needle["properties"]["gauge"]["x-diameters-mm"] = [float(mm) for mm in GAUGE_DIAMETER_MM.values()]
    needle["allOf"] = [{"oneOf": [{"required": [key]} for key in pair]} for pair in ALTERNATIVES]
    schema["properties"]["membrane"]["minItems"] = 1
    syringe = schema["properties"]["syringe"]
    schema["properties"]["syringe"] = {"$ref": syringe["anyOf"][0]["$ref"], "x-optional": True}
    return schema


def _complete(entry: JsonSchemaValue, key: str, field: FieldBounds | None) -> None:
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
    unit = split_key(key)[1]
    if unit.name:
        entry["x-unit"] = unit.name
    if field is None or number is None:
        return
    for bound, is_open, closed_name, open_name in (
        (field["min"], field["min_open"], "minimum", "exclusiveMinimum"),
        (field["max"], field["max_open"], "maximum", "exclusiveMaximum"),
    ):
        if math.isfinite(bound):
            number[open_name if is_open else closed_name] = bound / to_si(Decimal(1), unit)
    entry["x-reason"] = field["reason"]

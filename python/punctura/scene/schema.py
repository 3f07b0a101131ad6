"""The schema of scene files, from the core's table of their keys, for the reader, the writer and the JSON Schema.

The core also checks the values. Bounds and defaults of the JSON Schema come from the same table.
"""

import math
from decimal import Decimal
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from pydantic import Field, create_model
from pydantic.json_schema import JsonSchemaValue

from punctura._core import SceneKey, gauge_diameters, scene_keys, scene_tables
from punctura.files.fields import Name, Number, NumberOrAutomatic, Numbers, Vector, WholeNumber
from punctura.files.tables import Table
from punctura.files.units import from_si, split_key, to_si

KEYS: dict[str, list[SceneKey]] = {name: [] for name, *_ in scene_tables()}  # of each table; "" is the file itself
for _key in scene_keys():
    KEYS[_key.table].append(_key)

# Lists of a table that have the same length: each place of them is one row of a list in the core. By table: the core's
# list, and the core's name of each key.
ROWS: dict[str, dict[str, dict[str, str]]] = {name: {} for name in KEYS}
for _key in scene_keys():
    if _key.kind == "column":
        _list, _column = _key.name.split("[].")
        ROWS[_key.table].setdefault(_list, {})[_key.key] = _column

# The file gives exactly one key of each pair.
ALTERNATIVES = tuple(
    (next(first.key for first in keys if first.name == key.instead_of), key.key)
    for keys in KEYS.values()
    for key in keys
    if key.instead_of
)

_words: Any = Literal
_TYPES: dict[str, Any] = {
    "number": Number, "number_or_word": NumberOrAutomatic, "vector": Vector, "column": Numbers, "text": Name,
    "gauge": WholeNumber,
}  # fmt: skip


def in_file(key: SceneKey, value: Any) -> Any:
    """A value in SI as the file has it: a number in the unit of its key."""
    return from_si(value, split_key(key.key)[1]) if isinstance(value, float) else value


def _field(key: SceneKey) -> tuple[Any, Any]:
    kind = _words[tuple(key.words)] if key.kind == "word" else _TYPES[key.kind]
    default: Any = ... if key.required else in_file(key, key.default)
    if any(key.key in pair for pair in ALTERNATIVES):
        kind, default = kind | None, None
    extra = {"x-symbol": key.symbol, "x-folded": key.group}
    filled: Any = {name: text for name, text in extra.items() if text}
    return kind, Field(default, title=key.title, description=key.help, json_schema_extra=filled or None)


def _model(name: str, title: str, help: str, fields: dict[str, Any]) -> type[Table]:
    fields = {key.key: _field(key) for key in KEYS[name]} | fields
    title_of = f"{title}Table" if name else "SceneFile"
    return create_model(title_of, __base__=Table, __doc__=help, __cls_kwargs__={"title": title}, **fields)


_FILE, *_TABLES = scene_tables()
MODELS: dict[str, type[Table]] = {name: _model(name, title, help, {}) for name, title, help, _ in _TABLES}


def _table(name: str, title: str, required: bool) -> tuple[Any, Any]:
    model: Any = MODELS[name]
    if name == "membrane":
        help = "In the order in which their forces are added."
        return list[model], Field(..., title=f"{title}s", description=help)
    if required:
        return model, ...
    optional = any(key.required for key in KEYS[name])
    return (model | None, Field(None, title=title)) if optional else (model, Field(default_factory=model))


if TYPE_CHECKING:
    SceneFile = Table
    Look: TypeAlias = str
    Behind: TypeAlias = str
else:
    SceneFile = _model(*_FILE[:3], {name: _table(name, title, required) for name, title, _, required in _TABLES})
    Look, Behind = (MODELS["membrane"].model_fields[key].annotation for key in ("look", "behind"))


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

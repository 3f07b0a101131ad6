"""Everything that is wrong with a scene file's tables, in the file's own keys and units.

Wrong types are found by the schema, wrong values by the core, on the same reading: where a value has the wrong type, a
harmless one stands in for it while the core looks at the rest.
"""

from __future__ import annotations

import difflib
import json
import math
import re
from collections.abc import Iterator, Mapping
from decimal import Decimal
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from punctura import _core
from punctura.errors import MISSING, Problem
from punctura.scene.build import Parts, scene_parts
from punctura.scene.gauges import GAUGE_DIAMETER_MM
from punctura.scene.schema import ALTERNATIVES, CouplingTable, MembraneTable, NeedleTable, SceneFile, ServoTable
from punctura.scene.units import split_key, to_si

_TABLES: dict[str, type[BaseModel]] = {
    "needle": NeedleTable, "coupling": CouplingTable, "servo": ServoTable, "membrane": MembraneTable,
}  # fmt: skip
Location = tuple[int | str, ...]  # of a value in the file: ("membrane", 1, "friction")

_ENOUGH = 100  # membranes to look at: more than the core takes, and so few that all their problems can be told


def check_tables(data: dict[str, Any]) -> tuple[SceneFile | None, list[Problem]]:
    """The scene file of these tables, if it is sound, and every problem if it is not."""
    tables = data.get("membrane")
    if isinstance(tables, list) and len(tables) > _ENOUGH:
        data = data | {"membrane": tables[:_ENOUGH]}
    problems = [(_location(p.path), p) for p in _alternative_problems(data)]
    scene_file: SceneFile | None = None
    try:
        scene_file = SceneFile.model_validate(data)
    except ValidationError as error:
        problems = [(e["loc"], _type_problem(e)) for e in error.errors(include_url=False)] + problems
    problems += [(_location(p.path), p) for p in _domain_problems(data, {p.path for _, p in problems})]
    order = _Order(data)
    problems.sort(key=lambda located: order.place(located[0]))
    return (None if problems else scene_file), [problem for _, problem in problems]


def _path(location: Location) -> str:
    """A key that TOML wants in quotes has them here, too: its dots and brackets are its own."""
    text = ""
    for part in location:
        if isinstance(part, int):
            text += f"[{part}]"
        else:
            key = part if re.fullmatch("[A-Za-z0-9_-]+", part) else json.dumps(part, ensure_ascii=False)
            text += f".{key}" if text else key
    return text


def _location(path: str) -> Location:
    """Of a path whose keys are the schema's own."""
    return tuple(int(part) if part.isdigit() else part for part in re.findall(r"[^.\[\]]+", path))


def _shown(value: Any) -> object:
    """A value as a message shows it: tables and lists of tables are too long to show."""
    if isinstance(value, Decimal):
        return float(value)
    if isinstance(value, list) and not any(isinstance(v, (dict, list)) for v in value):
        return [_shown(v) for v in value]
    return MISSING if isinstance(value, (dict, list)) else value


def _type_problem(error: ErrorDetails) -> Problem:
    location, kind = error["loc"], error["type"]
    path, key = _path(location), str(location[-1])
    if kind == "missing":
        is_table = path in _TABLE_HEADS
        return Problem(path, MISSING, f"is missing; write a table {_TABLE_HEADS[path]}" if is_table else "is missing")
    if kind == "extra_forbidden":
        return Problem(path, _shown(error["input"]), _unknown_key(location))
    if kind == "literal_error":
        return Problem(path, _shown(error["input"]), f"must be {error['ctx']['expected']}")
    if kind in ("model_type", "model_attributes_type"):
        table = f"[[{location[0]}]]" if len(location) > 1 else f"[{key}]"
        return Problem(path, _shown(error["input"]), f"must be a table, {table}")
    if kind == "list_type":
        return Problem(path, _shown(error["input"]), f"must be a list of tables; begin each with [[{key}]]")
    unit = split_key(key)[1].name
    return Problem(path, _shown(error["input"]), error["msg"] + (f" ({unit})" if unit else ""))


_TABLE_HEADS = {"needle": "[needle]", "coupling": "[coupling]", "membrane": "[[membrane]]"}


def _unknown_key(location: tuple[int | str, ...]) -> str:
    names = [part for part in location if isinstance(part, str)]
    table = SceneFile if len(names) == 1 else _TABLES[names[0]]
    known = list(table.model_fields)
    near = difflib.get_close_matches(names[-1], known, n=1) or [k for k in known if split_key(k)[0] == names[-1]]
    return f"unknown key; did you mean {near[0]}?" if near else f"unknown key; known here: {', '.join(known)}"


def _alternative_problems(data: Mapping[str, Any]) -> Iterator[Problem]:
    needle = data.get("needle")
    if not isinstance(needle, dict):
        return
    for one, other in ALTERNATIVES:
        if one in needle and other in needle:
            yield Problem(f"needle.{other}", _shown(needle[other]), f"give either {one} or {other}, not both")
        elif one not in needle and other not in needle:
            yield Problem(f"needle.{one}", MISSING, f"is missing; give either {one} or {other}")
    gauge = needle.get("gauge")
    if type(gauge) is int and gauge not in GAUGE_DIAMETER_MM:
        low, high = min(GAUGE_DIAMETER_MM), max(GAUGE_DIAMETER_MM)
        yield Problem("needle.gauge", gauge, f"must be a gauge of ISO 9626, {low} to {high}")


def _domain_problems(data: Mapping[str, Any], unsound: set[str]) -> list[Problem]:
    parts: Parts = scene_parts(data, unsound)
    problems = []
    for path, value, reason in _core.scene_problems(*parts.arguments[:5]):
        if path in parts.stand_ins:
            continue
        key_path = parts.keys.get(path, path)
        given = _lookup(data, key_path)
        shown = _shown(given) if given is not None else value
        problems.append(Problem(key_path, shown, reason + _bound_in_unit(path, key_path, value)))
    return problems


def _bound_in_unit(path: str, key_path: str, value: float) -> str:
    """The bound that is broken in the key's unit, where that is not the core's: `(at most 90 deg)`."""
    unit = split_key(key_path)[1]
    if not isinstance(value, float) or not math.isfinite(value) or unit.si == 1:
        return ""
    for field in _core.fields():
        if field["path"] != re.sub(r"\[\d+\]", "", path):
            continue
        low, high = field["min"], field["max"]
        for broken, bound, word in (
            (value <= low, low, "more than" if field["min_open"] else "at least"),
            (value >= high, high, "less than" if field["max_open"] else "at most"),
        ):
            if broken and bound != 0 and math.isfinite(bound):
                return f" ({word} {bound / to_si(Decimal(1), unit):g} {unit.name})"
    return ""


def _lookup(data: Any, path: str) -> Any:
    for part in _location(path):
        if isinstance(data, list) and isinstance(part, int) and part < len(data):
            data = data[part]
        elif isinstance(data, dict):
            data = data.get(part)
        else:
            return None
    return data


class _Order:
    """Where a problem's field stands in the file, so that problems are told from top to bottom."""

    def __init__(self, data: Mapping[str, Any]) -> None:
        self._data = data
        self._ranks: dict[int, dict[str, int]] = {}  # of a table's keys, by the table

    def place(self, location: Location) -> tuple[int, ...]:
        place: list[int] = []
        here: Any = self._data
        for part in location:
            if isinstance(here, dict) and isinstance(part, str):
                if id(here) not in self._ranks:
                    self._ranks[id(here)] = {key: rank for rank, key in enumerate(here)}
                ranks = self._ranks[id(here)]
                place.append(ranks.get(part, len(ranks)))
                here = here.get(part)
            elif isinstance(here, list) and isinstance(part, int):
                place.append(part)
                here = here[part] if part < len(here) else None
        return tuple(place)

"""Messages for single keys and values of an exercise file that are wrong."""

from __future__ import annotations

from pydantic import BaseModel
from pydantic_core import ErrorDetails

from punctura.errors import MISSING, Problem
from punctura.exercise.fields import Space, Start
from punctura.exercise.goals import GOALS
from punctura.exercise.schema import ExerciseFile
from punctura.files.tables import missing, path_of, shown, unknown_key
from punctura.files.toml import Location
from punctura.files.units import split_key

_TABLES: dict[str, type[BaseModel]] = {"start": Start, "space": Space}
_HEADS = {"start": "[start]", "space": "[space]", "goal": "[[goal]]"}
_UNITS = {"seconds": "s", "at_most_mm_per_s": "mm/s"}  # for keys that do not end in their unit

_TYPES = {
    "string_type": "must be text, in quotes",
    "string_too_short": "must not be empty",
    "string_too_long": "must have at most {max_length} characters",
    "float_type": "must be a number",
    "finite_number": "must be a finite number",
    "int_type": "must be a whole number",
    "bool_type": "must be true or false",
    "greater_than": "must be more than {gt:g}{unit}",
    "greater_than_equal": "must be at least {ge:g}{unit}",
    "less_than_equal": "must be at most {le:g}{unit}",
}


def located(error: ErrorDetails) -> tuple[Location, str]:
    """The value's location in the file, and the kind of its goal, or "".

    Pydantic names the kind within the location.
    """
    loc = error["loc"]
    if len(loc) > 2 and loc[0] == "goal" and loc[2] in GOALS:
        return (*loc[:2], *loc[3:]), str(loc[2])
    return loc, ""


def problem(error: ErrorDetails) -> Problem:
    """The problem: where it is, and what the value must be."""
    location, goal = located(error)
    path = path_of(location)
    given = error["input"]
    if error["type"] in ("union_tag_invalid", "union_tag_not_found"):
        tag = given.get("kind", MISSING) if isinstance(given, dict) else MISSING
        return Problem(f"{path}.kind", tag, f"must be one of {', '.join(GOALS)}")
    return Problem(path, _shown(error), _reason(error, location, goal))


def _shown(error: ErrorDetails) -> object:
    return MISSING if error["type"] == "missing" else shown(error["input"])


def _reason(error: ErrorDetails, location: Location, goal: str) -> str:
    kind = error["type"]
    key = next((part for part in reversed(location) if isinstance(part, str)), "")
    if kind == "missing":
        return missing(_HEADS.get(key) if len(location) == 1 else None)
    if kind == "extra_forbidden":
        table = ExerciseFile if len(location) == 1 else GOALS.get(goal) or _TABLES.get(str(location[0]), ExerciseFile)
        return unknown_key(key, table)
    if kind in _TYPES:
        unit = _UNITS.get(key) or split_key(key)[1].name
        return _TYPES[kind].format(**error.get("ctx", {}), unit=f" {unit}" if unit else "")
    if len(location) == 1 and key == "goal":
        return "must be a list of one or more tables; begin each with [[goal]]"
    if kind in ("list_type", "too_short", "too_long"):
        return "must be three numbers, [x, y, z]"
    if key in _HEADS:
        return f"must be a table, {_HEADS[key]}"
    return error["msg"][:1].lower() + error["msg"][1:]

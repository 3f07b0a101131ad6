"""Finds all problems of an exercise file at once.

The schema checks single keys. The functions below check combinations of keys. They use every value that is valid by
itself, even if other values in the same table are not.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from punctura import Scene
from punctura.errors import MISSING, Problem
from punctura.exercise.depths import unreachable
from punctura.exercise.exercise import ExerciseFile, start_axis
from punctura.exercise.fields import FARTHEST_START_MM, LEAST_MM, Space, Start, no_direction
from punctura.exercise.goals import GOALS, Given
from punctura.files.tables import missing, path_of, shown, unknown_key
from punctura.files.toml import Location, Tables
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


class Sound(NamedTuple):
    """The values that are valid by themselves, and the defaults of missing keys."""

    start: Given
    space: Given
    goals: dict[int, Given]  # by index; goals of an unknown kind are left out


def check_tables(tables: Tables, scene: Scene | None) -> tuple[ExerciseFile | None, list[Problem]]:
    """The exercise file of these tables if it is valid, and all problems. scene: None if the scene is invalid."""
    file, problems, unsound = None, [], set[Location]()
    try:
        file = ExerciseFile.model_validate(tables)
    except ValidationError as error:
        errors = error.errors(include_url=False)
        problems = [problem(e) for e in errors]
        unsound = {located(e)[0] for e in errors}
    sound = _sound(tables, unsound)
    problems += _kinds(tables.get("goal"), sound.goals)
    problems += _start(sound.start, scene)
    problems += _names(sound, scene)
    problems += _goals(sound, scene)
    problems += unreachable(sound.space, sound.goals, scene)
    return (None if problems else file), problems


def _sound(tables: Tables, unsound: set[Location]) -> Sound:
    def values(model: type[BaseModel], given: object, place: Location) -> Given:
        if not isinstance(given, dict):
            return {}
        bad = {where[len(place)] for where in unsound if where[: len(place)] == place and len(where) > len(place)}
        return {
            key: given.get(key, field.default)
            for key, field in model.model_fields.items()
            if key not in bad and (key in given or not field.is_required())
        }

    given = tables.get("goal")
    goals = {}
    for i, goal in enumerate(given if isinstance(given, list) else []):
        kind = goal.get("kind") if isinstance(goal, dict) else None
        if isinstance(kind, str) and kind in GOALS:
            goals[i] = values(GOALS[kind], goal, ("goal", i))
    start, space = (values(model, tables.get(key), (key,)) for key, model in (("start", Start), ("space", Space)))
    return Sound(start, space, goals)


def _kinds(given: object, goals: dict[int, Given]) -> Iterator[Problem]:
    if not isinstance(given, list) or not given or len(goals) < len(given):
        return
    if not any(goal["kind"] in ("reach", "stay") for goal in goals.values()):
        yield Problem(
            "goal", MISSING, "at least one goal must be of kind reach or stay, else there is nothing to achieve"
        )


def _start(start: Given, scene: Scene | None) -> Iterator[Problem]:
    position = start.get("position_mm")
    if position is not None:
        away = math.hypot(*position)
        if away > FARTHEST_START_MM:
            reason = f"must be at most {FARTHEST_START_MM:g} mm from the scene's origin; it is {away:.4g} mm from it"
            yield Problem("start.position_mm", position, reason)
        elif scene is not None:
            yield from _in_front(position, scene)
    heading = start.get("heading")
    if heading is None:
        return
    if reason := no_direction(heading):
        yield Problem("start.heading", heading, reason)
    elif scene is not None and "angle_deg" in start:
        try:
            start_axis(scene, start["angle_deg"], heading)
        except ValueError as bad:
            yield Problem("start.heading", heading, str(bad))


def _in_front(position_mm: list[float], scene: Scene) -> Iterator[Problem]:
    """The start must lie in front of all membranes, because an attempt starts there."""
    depths = []
    for placed in scene.membranes:
        normal = np.asarray(placed.inward_normal) / np.linalg.norm(placed.inward_normal)
        depths.append(float(normal @ (np.asarray(position_mm) - np.asarray(placed.point) * 1e3)))
    worst = int(np.argmax(depths))
    if depths[worst] > -LEAST_MM:
        side = "behind" if depths[worst] > 0 else "in front of"
        reason = (
            f"must be at least {LEAST_MM:g} mm in front of every membrane; "
            f"it is {abs(depths[worst]):.4g} mm {side} the {scene.membranes[worst].name}"
        )
        yield Problem("start.position_mm", position_mm, reason)


def _goals(sound: Sound, scene: Scene | None) -> Iterator[Problem]:
    for i, goal in sound.goals.items():
        kind = GOALS[goal["kind"]]
        for key, value, reason in kind.problems(goal, sound.space, scene):
            yield Problem(f"goal[{i}].{key}", value, reason)
        if kind.needs_syringe and scene is not None and scene.syringe is None:
            yield Problem(f"goal[{i}].kind", goal["kind"], "needs a scene with a syringe: its file has no [syringe]")


def _names(sound: Sound, scene: Scene | None) -> Iterator[Problem]:
    space = sound.space
    asked = [(f"space.{key}", space[key]) for key in ("behind", "in_front_of") if space.get(key) is not None]
    asked += [(f"goal[{i}].membrane", goal["membrane"]) for i, goal in sound.goals.items() if "membrane" in goal]
    names = [] if scene is None else [placed.name for placed in scene.membranes]
    for where, name in asked if scene is not None else []:
        if names.count(name) != 1:
            yield Problem(where, name, f"must be one of the scene's membranes: {', '.join(names)}")
    if space.get("behind") is not None and space["behind"] == space.get("in_front_of"):
        yield Problem("space.in_front_of", space["in_front_of"], "must be another membrane than space.behind")

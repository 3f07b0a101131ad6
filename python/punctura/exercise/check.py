"""Finds all problems of an exercise file at once.

The schema checks single keys. The functions below check combinations of keys. They use every value that is valid by
itself, even if other values in the same table are not.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from pydantic import BaseModel, ValidationError

from punctura import Scene
from punctura.errors import MISSING, Problem
from punctura.exercise.depths import unreachable
from punctura.exercise.exercise import start_axis
from punctura.exercise.fields import FARTHEST_START_MM, LEAST_MM, Space, Start, no_direction
from punctura.exercise.goals import GOALS, Given
from punctura.exercise.problems import located, problem
from punctura.exercise.schema import ExerciseFile
from punctura.files.toml import Location, Tables


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

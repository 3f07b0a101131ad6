"""Exercise files: reading and checking."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from punctura import Scene
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.exercise.depths import unreachable
from punctura.exercise.exercise import Exercise, start_axis
from punctura.exercise.schema import ExerciseFile
from punctura.scene import load_scene, scene_names
from punctura.scene.parse import read_tables

_FOLDER = Path(__file__).parents[1] / "exercises"


def exercise_names() -> list[str]:
    """Names of the ready exercises, as load_exercise takes them."""
    return sorted(file.stem for file in _FOLDER.glob("*.toml"))


def exercises() -> list[Exercise]:
    """The ready exercises."""
    return [load_exercise(name) for name in exercise_names()]


def load_exercise(name_or_path: str | os.PathLike[str]) -> Exercise:
    """A ready exercise by its name, or one from a file. Raises ConfigurationError with everything that is wrong."""
    path = _path_of(name_or_path)
    tables = read_tables(path, "exercise")
    file, problems = _checked(tables)
    scene, scene_name, scene_problems = _scene_of(tables.get("scene"), path)
    problems += scene_problems
    if file is not None and scene is not None:
        problems += _misfits(file, scene)
    if problems or file is None or scene is None:
        raise ConfigurationError(problems, str(path))
    return Exercise(path.stem, path, file, scene, scene_name)


def _path_of(name_or_path: str | os.PathLike[str]) -> Path:
    path = Path(name_or_path)
    if isinstance(name_or_path, str) and not path.suffix and path.name == name_or_path:
        if name_or_path in exercise_names():
            return _FOLDER / f"{name_or_path}.toml"
        known = ", ".join(exercise_names())
        reason = f"there is no ready exercise of this name; ready exercises: {known}"
        raise ConfigurationError([Problem("", MISSING, reason)], name_or_path)
    return path


def _checked(tables: dict[str, Any]) -> tuple[ExerciseFile | None, list[Problem]]:
    try:
        return ExerciseFile.model_validate(tables), []
    except ValidationError as error:
        return None, [_problem(e) for e in error.errors(include_url=False)]


def _problem(error: ErrorDetails) -> Problem:
    """In the words of a scene file's problems. A goal's kind is no part of its path."""
    kinds = ("reach", "stay", "never_pass", "stop_after_pop", "time_limit", "peak_force", "attempts")
    parts = [p for i, p in enumerate(error["loc"]) if not (i == 2 and error["loc"][0] == "goal" and p in kinds)]
    path = "".join(f"[{p}]" if isinstance(p, int) else f".{p}" for p in parts).lstrip(".")
    kind, given = error["type"], error["input"]
    if kind == "missing":
        return Problem(path, MISSING, "is missing")
    if kind == "extra_forbidden":
        return Problem(path, given, "unknown key")
    if kind in ("union_tag_invalid", "union_tag_not_found"):
        tag = given.get("kind", MISSING) if isinstance(given, dict) else MISSING
        return Problem(f"{path}.kind", tag, f"must be one of {', '.join(kinds)}")
    shown = MISSING if isinstance(given, dict | list) else given
    return Problem(path, shown, error["msg"][:1].lower() + error["msg"][1:])


def _scene_of(given: Any, path: Path) -> tuple[Scene | None, str, list[Problem]]:
    if not isinstance(given, str) or not given:
        return None, "", []
    name = given if given in scene_names() else str(path.parent / given)
    try:
        return load_scene(name), name, []
    except ConfigurationError as bad:
        return None, name, [Problem("scene", given, "; ".join(str(p) for p in bad.problems))]


def _misfits(file: ExerciseFile, scene: Scene) -> Iterator[Problem]:
    """What does not go together with the scene, and goals that can never be judged."""
    names = [placed.name for placed in scene.membranes]
    asked = [("space.behind", file.space.behind)]
    asked += [("space.in_front_of", file.space.in_front_of)] if file.space.in_front_of is not None else []
    asked += [(f"goal[{i}].membrane", goal.membrane) for i, goal in enumerate(file.goal) if hasattr(goal, "membrane")]
    known = True
    for where, name in asked:
        if names.count(name) != 1:
            known = False
            yield Problem(where, name, f"must be one of the scene's membranes: {', '.join(names)}")
    if file.space.behind == file.space.in_front_of:
        yield Problem("space.in_front_of", file.space.in_front_of, "must be another membrane than space.behind")
    elif known:
        yield from unreachable(file, scene)
    if not any(goal.kind in ("reach", "stay") for goal in file.goal):
        yield Problem("goal", MISSING, "one at least must be of kind reach or stay: without it nothing can be achieved")
    try:
        start_axis(scene, file.start.angle_deg, file.start.heading)
    except ValueError as bad:
        yield Problem("start.heading", file.start.heading, str(bad))

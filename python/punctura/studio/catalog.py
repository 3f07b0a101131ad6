"""What there is to choose from."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.exercise import Attempt, Exercise, exercise_names, exercises, load_exercise
from punctura.scene import load_scene, scene_names
from punctura.studio.loaded import problem_parts
from punctura.studio.names import BadName, safe_name
from punctura.studio.wire.messages import Choice


@cache
def _ready_scenes() -> tuple[Choice, ...]:
    return tuple(Choice(name=name, title=load_scene(name).name) for name in scene_names())


def ready_scenes() -> list[Choice]:
    """The scenes that come with the package."""
    return list(_ready_scenes())


class Exercises:
    """Those that come with the package, and files that the command line has named.

    A file is read anew each time, so that it may be written while the studio runs. A page chooses by name: it cannot
    name a file.
    """

    def __init__(self, files: Sequence[str | os.PathLike[str]] = ()) -> None:
        """Raises ConfigurationError where a file is no sound exercise, or has the name of another."""
        self._files: dict[str, Path] = {}
        self._titles: dict[str, str] = {}
        self.warnings: list[tuple[Path, Problem]] = []  # of the files as they are now
        for given in files:
            if given in exercise_names():
                continue  # it is listed anyhow
            exercise = load_exercise(given)
            reason = self._unfit(exercise.name, exercise.path)
            if reason:
                raise ConfigurationError([Problem("", MISSING, reason)], str(exercise.path))
            self._files[exercise.name] = exercise.path.absolute()
            self._titles[exercise.name] = exercise.title
            self.warnings += [(exercise.path, warning) for warning in exercise.warnings]

    def _unfit(self, name: str, path: Path) -> str:
        """Why a file, or its name, by which the page and its results know it, cannot be listed."""
        if not path.is_file():
            return "is not a file that can be read again and again"
        if name in exercise_names():
            return f"has the name of the ready exercise {name}; name the file otherwise"
        if name in self._files:
            return f"has the same name as {self._files[name]}; name one of them otherwise"
        try:
            safe_name(name)
        except BadName as bad:
            return f"cannot be listed by its name: {bad}"
        return ""

    def names(self) -> list[str]:
        """One's own first."""
        return [*self._files, *exercise_names()]

    def load(self, name: str) -> Exercise:
        """Raises ConfigurationError where a file is not sound any more; KeyError for a name that is not listed."""
        if name not in self.names():
            raise KeyError(name)
        return load_exercise(self._files.get(name, name))

    def overviews(self) -> list[dict[str, Any]]:
        """What they are, and where the needle begins (m); for a file that is not sound, what is wrong with it."""
        return [self._own(name) for name in self._files] + [dict(entry) for entry in _ready_exercises()]

    def choices(self) -> list[Choice]:
        """By the titles that they had when the studio began."""
        own = [Choice(name=name, title=title) for name, title in self._titles.items()]
        return own + [Choice(name=entry["name"], title=entry["title"]) for entry in _ready_exercises()]

    def _own(self, name: str) -> dict[str, Any]:
        try:
            return _overview(self.load(name))
        except ConfigurationError as error:
            wrong = _for_page(error.problems)
            return _NOTHING | {"name": name, "title": self._files[name].name, "problems": wrong}


_NOTHING: dict[str, Any] = {
    "description": "", "instruction": "", "scene": "", "space": [], "space_from": 0.0, "space_to": None,
    "goal_from": 0.0,
    "start_position": [0.0, 0.0, 0.0], "start_axis": [0.0, -1.0, 0.0], "goals": [], "warnings": [],
}  # fmt: skip


def _for_page(problems: Sequence[Problem]) -> list[dict[str, Any]]:
    return [part.model_dump(mode="json") for part in problem_parts(problems)]


def _overview(exercise: Exercise) -> dict[str, Any]:
    return {
        "name": exercise.name,
        "title": exercise.title,
        "description": " ".join(exercise.description.split()),
        "instruction": exercise.instruction,
        "scene": exercise.scene.name,
        "space": list(exercise.space),
        "space_from": exercise.space_depth[0],
        "space_to": exercise.space_depth[1],
        "goal_from": exercise.goal_depth,
        "start_position": list(exercise.start_position),
        "start_axis": list(exercise.start_axis),
        "goals": [goal.text for goal in Attempt(exercise, exercise.scene).goals],
        "problems": [],
        "warnings": _for_page(exercise.warnings),
    }


@cache
def _ready_exercises() -> tuple[dict[str, Any], ...]:
    return tuple(_overview(exercise) for exercise in exercises())

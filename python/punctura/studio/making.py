"""Requests of a page that makes exercises: check, save and delete. All run in any thread, and touch no run."""

from __future__ import annotations

from punctura.exercise import Exercise, exercise_of
from punctura.exercise.text import exercise_text
from punctura.studio.catalog import DRAFT, Exercises
from punctura.studio.names import safe_name
from punctura.studio.wire import requests as ask


def made_of(tables: dict[str, object]) -> Exercise:
    """The exercise of a page's tables. Raises ConfigurationError with all problems."""
    return exercise_of(tables, DRAFT)


def make(
    request: ask.CheckExercise | ask.SaveExercise | ask.DeleteExercise, exercises: Exercises
) -> tuple[str, dict[str, str | int]]:
    """The reply's text and data. Raises ConfigurationError, ValueError, OSError."""
    own = exercises.own
    if isinstance(request, ask.CheckExercise):
        checked = made_of(request.tables)
        return " ".join(str(warning) for warning in checked.warnings), {"toml": exercise_text(checked.file)}
    if own is None:
        raise ValueError("this studio has no folder for exercises")
    name = safe_name(request.name)
    if isinstance(request, ask.DeleteExercise):
        own.delete(name)
        return "", {}
    if exercises.taken(name):
        raise ValueError(f"{name} is the name of another exercise; choose another name")
    path = own.save(name, made_of(request.tables), request.replace)
    return f"saved in {path}", {"name": name}

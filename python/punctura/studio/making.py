"""Requests of a page that makes or opens exercises. All run in any thread, and touch no run."""

import base64

from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.exercise import Exercise, exercise_of, exercise_of_bytes
from punctura.exercise.exercise import exercise_text
from punctura.studio.catalog import DRAFT, Exercises
from punctura.studio.limits import MOST_TEXT
from punctura.studio.names import safe_name
from punctura.studio.own_exercises import OwnExercises
from punctura.studio.wire import requests as ask

Made = tuple[str, dict[str, str | int]]  # a reply's text and data


def made_of(tables: dict[str, object]) -> Exercise:
    """The exercise of a page's tables. Raises ConfigurationError with all problems."""
    return exercise_of(tables, DRAFT)


def make(
    request: ask.CheckExercise | ask.SaveExercise | ask.OpenExercise | ask.DeleteExercise, exercises: Exercises
) -> Made:
    """The reply's text and data. Raises ConfigurationError, ValueError, OSError."""
    own = exercises.own
    if isinstance(request, ask.CheckExercise):
        checked = made_of(request.tables)
        return _warnings(checked), {"toml": exercise_text(checked.file)}
    if own is None:
        raise ValueError("this studio has no folder for exercises")
    name = safe_name(request.name)
    if isinstance(request, ask.DeleteExercise):
        own.delete(name)
        return "", {}
    if exercises.taken(name):
        raise ValueError(f"{name} is the name of another exercise; choose another title, or rename the file")
    if isinstance(request, ask.OpenExercise):
        return _open(request, name, own)
    exercise = made_of(request.tables)
    own.save(name, exercise, request.replace)
    return _warnings(exercise), {"name": name}


def _open(request: ask.OpenExercise, name: str, own: OwnExercises) -> Made:
    """Keeps the file as it is, with its comments. Its scene is a ready one, so it means the same in any folder."""
    try:
        data = base64.b64decode(request.file, validate=True)
    except ValueError:
        raise ValueError("the page has not sent the bytes of a file as base64") from None
    if len(data) > MOST_TEXT:
        reason = f"is larger than {MOST_TEXT // 1000} kB: no exercise needs that"
        raise ConfigurationError([Problem("", MISSING, reason)], name)
    exercise = exercise_of_bytes(data, name)
    own.keep(name, data, request.replace)
    return _warnings(exercise), {"name": name}


def _warnings(exercise: Exercise) -> str:
    return " ".join(str(warning) for warning in exercise.warnings)

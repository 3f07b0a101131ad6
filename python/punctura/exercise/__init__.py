"""Exercises: files with a task in a scene and its goals; attempts; results (docs/exercises.md)."""

from punctura.exercise.attempt import Attempt
from punctura.exercise.course import cannot_show, expected_losses, thumb_cannot_show
from punctura.exercise.exercise import Exercise, exercise_json_schema
from punctura.exercise.load import exercise_names, exercise_of, exercise_of_bytes, exercises, load_exercise, score
from punctura.exercise.result import Coaching, GoalState, Loss, Metrics, Overshoot, Remark, Result, Status
from punctura.exercise.results import ResultsError, ResultStore, default_folder

__all__ = [
    "Attempt",
    "Coaching",
    "Exercise",
    "GoalState",
    "Loss",
    "Metrics",
    "Overshoot",
    "Remark",
    "Result",
    "ResultStore",
    "ResultsError",
    "Status",
    "cannot_show",
    "default_folder",
    "exercise_json_schema",
    "exercise_names",
    "exercise_of",
    "exercise_of_bytes",
    "exercises",
    "expected_losses",
    "load_exercise",
    "score",
    "thumb_cannot_show",
]

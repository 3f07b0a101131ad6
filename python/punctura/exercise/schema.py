"""The schema of exercise files (docs/exercises.md)."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field
from pydantic.json_schema import JsonSchemaValue

from punctura.exercise.fields import Space, Start, Text, Word
from punctura.exercise.goals import GOALS, AnyGoal
from punctura.files.tables import Table


class ExerciseFile(Table):
    """An exercise: a scene, a task in it, and its goals."""

    title: Word
    description: Text
    instruction: Text
    scene: Word  # a ready scene's name, or the path of a scene file relative to this file
    level: Annotated[int, Field(ge=1, le=100)] = 100  # place in the list of the ready exercises: the easiest first
    blind: bool = False  # the page shows no needle and no depth while the exercise runs
    start: Start
    space: Space
    goal: Annotated[list[AnyGoal], Field(min_length=1)]


def exercise_json_schema() -> JsonSchemaValue:
    """JSON Schema of exercise files. `x-label` marks the key with which a form asks for a goal, `x-syringe` a goal that
    needs a syringe."""
    schema = ExerciseFile.model_json_schema()
    for goal in GOALS.values():
        schema["$defs"][goal.__name__]["x-syringe"] = goal.needs_syringe
    return schema

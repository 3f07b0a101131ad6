"""What there is to choose from."""

from __future__ import annotations

from functools import cache
from typing import Any

from punctura.exercise import Attempt, exercises
from punctura.scene import load_scene, scene_names
from punctura.studio.wire.messages import Choice


@cache
def _ready_scenes() -> tuple[Choice, ...]:
    return tuple(Choice(name=name, title=load_scene(name).name) for name in scene_names())


def ready_scenes() -> list[Choice]:
    """The scenes that come with the package."""
    return list(_ready_scenes())


@cache
def _exercises() -> tuple[dict[str, Any], ...]:
    return tuple(
        {
            "name": exercise.name,
            "title": exercise.title,
            "description": " ".join(exercise.description.split()),
            "instruction": exercise.instruction,
            "scene": exercise.scene.name,
            "space": list(exercise.space),
            "space_from": exercise.space_depth[0],
            "space_to": exercise.space_depth[1],
            "start_position": list(exercise.start_position),
            "start_axis": list(exercise.start_axis),
            "goals": [goal.text for goal in Attempt(exercise, exercise.scene).goals],
        }
        for exercise in exercises()
    )


def exercise_overviews() -> list[dict[str, Any]]:
    """The exercises that come with the package: what they are, and where the needle begins (m)."""
    return [dict(entry) for entry in _exercises()]


def exercise_choices() -> list[Choice]:
    return [Choice(name=entry["name"], title=entry["title"]) for entry in _exercises()]

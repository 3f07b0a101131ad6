"""An exercise: the schema of its file (docs/exercises.md), its text, and the exercise after checking."""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field
from pydantic.json_schema import JsonSchemaValue

from punctura import Scene
from punctura.errors import Problem
from punctura.exercise.fields import Space, Start, Text, Word
from punctura.exercise.goals import GOALS, AnyGoal, Reach
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


def exercise_text(file: ExerciseFile) -> str:
    """The TOML text of an exercise. Keys with their default values are left out."""
    tables = file.model_dump(exclude_defaults=True)
    heads = {key: tables.pop(key) for key in ("start", "space")}
    goals = [goal.model_dump(exclude_defaults=True) | {"kind": goal.kind} for goal in file.goal]
    tables.pop("goal")
    parts = [_lines(tables)]
    parts += [f"\n[{key}]\n{_lines(table)}" for key, table in heads.items()]
    parts += [f"\n[[goal]]\n{_lines({'kind': goal.pop('kind')} | goal)}" for goal in goals]
    return "".join(parts)


def _lines(table: Mapping[str, object]) -> str:
    return "".join(f"{key} = {_value(value)}\n" for key, value in table.items())


def _value(value: object) -> str:
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return f"[{', '.join(_value(one) for one in value)}]"
    return repr(value)


Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Exercise:
    """An exercise, as `load_exercise` returns it. SI."""

    name: str  # name of the file without its suffix
    path: Path  # of its file
    file: ExerciseFile  # what the file says
    scene: Scene  # as in its file; a device can run it at another rate
    scene_name: str  # a ready scene's name or a path, for load_scene
    warnings: tuple[Problem, ...] = ()  # allowed values that are usually a mistake

    @property
    def title(self) -> str:
        """For a list of exercises."""
        return self.file.title

    @property
    def description(self) -> str:
        """What it is about."""
        return self.file.description

    @property
    def instruction(self) -> str:
        """What to do, at the start."""
        return self.file.instruction

    @property
    def goals(self) -> list[AnyGoal]:
        """As in its file."""
        return list(self.file.goal)

    @property
    def space(self) -> tuple[int, ...]:
        """Index of the membrane in front of the space, and of the membrane behind the space if there is one."""
        names = (self.file.space.behind, self.file.space.in_front_of)
        return tuple(self.membrane(name) for name in names if name is not None)

    @property
    def space_depth(self) -> tuple[float, float | None]:
        """Distances from the first membrane's far face to the start and the end of the space, m; None: no such end."""
        space = self.file.space
        return space.depth_mm * 1e-3, None if space.deepest_mm is None else space.deepest_mm * 1e-3

    @property
    def goal_depth(self) -> float:
        """Depth behind the first membrane's far face to reach, m: of the reach goal, or of the space."""
        reach = next((goal for goal in self.file.goal if isinstance(goal, Reach)), None)
        return self.space_depth[0] if reach is None or reach.depth is None else reach.depth

    def membrane(self, name: str) -> int:
        """A membrane's index in the scene."""
        return [placed.name for placed in self.scene.membranes].index(name)

    @property
    def start_position(self) -> Triple:
        """Position of the tip at the start, m."""
        x, y, z = (v * 1e-3 for v in self.file.start.position_mm)
        return x, y, z

    @property
    def start_axis(self) -> Triple:
        """Direction of the needle at the start, of length 1, at `angle_deg` to the surface of the first membrane."""
        return start_axis(self.scene, self.file.start.angle_deg, self.file.start.heading)


def start_axis(scene: Scene, angle_deg: float, heading: list[float]) -> Triple:
    """Raises ValueError if a slanted needle needs a heading along the surface, but the heading has none."""
    normal = np.asarray(scene.membranes[0].inward_normal, dtype=np.float64)
    normal = normal / np.linalg.norm(normal)
    angle = math.radians(angle_deg)
    along = np.asarray(heading, dtype=np.float64)
    along = along - (along @ normal) * normal
    length = float(np.linalg.norm(along))
    if length < 1e-9 and angle_deg < 90:
        raise ValueError("must not be parallel to the first membrane's normal")
    axis = normal * math.sin(angle) + (along / length * math.cos(angle) if angle_deg < 90 else 0)
    return float(axis[0]), float(axis[1]), float(axis[2])

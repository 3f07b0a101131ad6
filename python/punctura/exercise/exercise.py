"""An exercise that was read and checked."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from punctura import Scene
from punctura.errors import Problem
from punctura.exercise.schema import AnyGoal, ExerciseFile, Reach

Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Exercise:
    """What `load_exercise` gives. SI."""

    name: str  # the file's, without its ending
    path: Path
    file: ExerciseFile
    scene: Scene  # as its file has it; a device may run it at another rate
    scene_name: str  # a ready scene's name, or a path: load_scene takes it
    warnings: tuple[Problem, ...] = ()  # what is allowed, but seldom meant

    @property
    def title(self) -> str:
        return self.file.title

    @property
    def description(self) -> str:
        return self.file.description

    @property
    def instruction(self) -> str:
        return self.file.instruction

    @property
    def goals(self) -> list[AnyGoal]:
        return list(self.file.goal)

    @property
    def space(self) -> tuple[int, ...]:
        """The membrane behind which the space is and, if there is one, that in front of which it ends."""
        names = (self.file.space.behind, self.file.space.in_front_of)
        return tuple(self.membrane(name) for name in names if name is not None)

    @property
    def space_depth(self) -> tuple[float, float | None]:
        """Where the space begins behind the far face of the first, m, and where it ends, if at a depth."""
        space = self.file.space
        return space.depth_mm * 1e-3, None if space.deepest_mm is None else space.deepest_mm * 1e-3

    @property
    def goal_depth(self) -> float:
        """How deep behind the far face of the first the needle must come, m: by its reach goal, or into the space."""
        reach = next((goal for goal in self.file.goal if isinstance(goal, Reach)), None)
        return self.space_depth[0] if reach is None or reach.depth_mm is None else reach.depth_mm * 1e-3

    def membrane(self, name: str) -> int:
        """A membrane's place in the scene."""
        return [placed.name for placed in self.scene.membranes].index(name)

    @property
    def start_position(self) -> Triple:
        """Where the tip waits, m."""
        x, y, z = (v * 1e-3 for v in self.file.start.position_mm)
        return x, y, z

    @property
    def start_axis(self) -> Triple:
        """Where the needle points, of length 1: at `angle_deg` to the surface of the first membrane."""
        return start_axis(self.scene, self.file.start.angle_deg, self.file.start.heading)


def start_axis(scene: Scene, angle_deg: float, heading: list[float]) -> Triple:
    """Raises ValueError where the heading has no direction along the surface, and the angle asks for one."""
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

"""Warns about goals that do not suit the length of the needle's tip: they are allowed, but usually a mistake."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from punctura import Scene
from punctura._core import tip_length
from punctura.errors import MISSING, Problem
from punctura.exercise.depths import space_end_mm
from punctura.exercise.exercise import start_axis
from punctura.exercise.goals import Reach, Stay
from punctura.exercise.schema import ExerciseFile


def tip_warnings(file: ExerciseFile, scene: Scene) -> Iterator[Problem]:
    """Warnings with depths in the file's units, for a needle in its direction at the start."""
    tip = _tip_mm(file, scene)
    space = file.space
    end, by = space_end_mm(space.model_dump(), scene)
    for i, goal in enumerate(file.goal):
        if not isinstance(goal, Reach | Stay):
            continue
        depth = (goal.depth_mm if isinstance(goal, Reach) else None) or space.depth_mm
        if goal.whole_tip and depth + tip >= end:
            reason = (
                f"the whole tip does not fit at the angle of the start: its end comes to {depth:g} mm only when the "
                f"point is at {depth + tip:.2f} mm, and the space ends at {end:g} mm, by {by}"
            )
            yield Problem(f"goal[{i}].whole_tip", True, reason)
        elif not goal.whole_tip and 0 < depth < tip:
            reason = (
                f"is met before the {space.behind} pops: the point is then {depth:g} mm past it, and the tip is "
                f"{tip:.2f} mm long in this direction; add whole_tip = true if all of the tip must be past it"
            )
            yield Problem(f"goal[{i}]", MISSING, reason)


def _tip_mm(file: ExerciseFile, scene: Scene) -> float:
    """Length of the tip along the normal of the membrane behind which the space is."""
    behind = next(placed for placed in scene.membranes if placed.name == file.space.behind)
    normal = np.asarray(behind.inward_normal) / np.linalg.norm(behind.inward_normal)
    axis = np.asarray(start_axis(scene, file.start.angle_deg, file.start.heading))
    return float(tip_length(scene.needle) * 1e3 * abs(axis @ normal))

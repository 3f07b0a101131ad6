"""Whether the depths of an exercise file leave a space that a needle can come to."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from punctura import Scene
from punctura.errors import Problem
from punctura.exercise.schema import ExerciseFile, Reach

PARALLEL = 1 - 1e-9  # cosine of the angle between two normals


def unreachable(file: ExerciseFile, scene: Scene) -> Iterator[Problem]:
    """Depths that lie behind the space's end. Membranes that are not parallel leave room for any depth."""
    space = file.space
    if space.in_front_of is None and space.press_mm > 0:
        yield Problem("space.press_mm", space.press_mm, "needs space.in_front_of: the membrane that may be pressed")
    if space.deepest_mm is not None and space.deepest_mm <= space.depth_mm:
        reason = f"must be more than {space.depth_mm:g}, where the space begins"
        yield Problem("space.deepest_mm", space.deepest_mm, reason)
        return
    ends = [(space.deepest_mm, "space.deepest_mm")] if space.deepest_mm is not None else []
    gap = _gap_mm(file, scene)
    if gap is not None:
        ends.append((gap + space.press_mm, f"the {space.in_front_of}"))
    end, what = min(ends, default=(np.inf, ""))
    if space.depth_mm > 0 and space.depth_mm >= end:
        yield Problem("space.depth_mm", space.depth_mm, f"must be less than {end:g}: there the space ends, by {what}")
        return
    for i, goal in enumerate(file.goal):
        if not isinstance(goal, Reach) or goal.depth_mm is None:
            continue
        where = f"goal[{i}].depth_mm"
        if goal.depth_mm < space.depth_mm:
            reason = f"must be {space.depth_mm:g} or more: there the space begins, by space.depth_mm"
            yield Problem(where, goal.depth_mm, reason)
        elif goal.depth_mm >= end:
            yield Problem(where, goal.depth_mm, f"must be less than {end:g}: there the space ends, by {what}")


def _gap_mm(file: ExerciseFile, scene: Scene) -> float | None:
    """From the far face of the one membrane to the near face of the other; None where they are not parallel."""
    if file.space.in_front_of is None:
        return None
    by_name = {placed.name: placed for placed in scene.membranes}
    one, other = by_name[file.space.behind], by_name[file.space.in_front_of]
    normals = [np.asarray(placed.inward_normal) for placed in (one, other)]
    n, m = (normal / np.linalg.norm(normal) for normal in normals)
    if n @ m < PARALLEL:
        return None
    return float(n @ (np.asarray(other.point) - np.asarray(one.point)) - one.membrane.thickness) * 1e3

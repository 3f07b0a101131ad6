"""Checks that the depths of an exercise file leave a space that a needle can reach, and suit the length of its tip."""

from collections.abc import Iterator, Mapping

import numpy as np

from punctura import Scene
from punctura._core import tip_length
from punctura.errors import MISSING, Problem
from punctura.exercise.exercise import ExerciseFile, start_axis
from punctura.exercise.fields import LEAST_MM
from punctura.exercise.goals import Given, MostDepth, Reach, Stay

PARALLEL = 1 - 1e-9  # cosine of the angle between two normals
ROUNDING_MM = 1e-9  # rounding error of sums and differences of decimal numbers


def unreachable(space: Given, goals: Mapping[int, Given], scene: Scene | None) -> Iterator[Problem]:
    """Problems: a depth behind the space's end, and a space that is too narrow.

    Between membranes that are not parallel, any depth is allowed.
    """
    if "in_front_of" in space and space["in_front_of"] is None and space.get("press_mm", 0) > 0:
        yield Problem(
            "space.press_mm", space["press_mm"], "needs space.in_front_of, the membrane that the tip may press"
        )
    begins = space.get("depth_mm")
    if begins is None:
        return
    deepest = space.get("deepest_mm")
    if deepest is not None and deepest < begins + LEAST_MM - ROUNDING_MM:
        reason = (
            f"must be at least {begins + LEAST_MM:g} mm: the space begins at {begins:g} mm and must be "
            f"at least {LEAST_MM:g} mm wide"
        )
        yield Problem("space.deepest_mm", deepest, reason)
        return
    end, by = space_end_mm(space, scene)
    if begins > end - LEAST_MM + ROUNDING_MM:
        yield _too_narrow(space, begins, end, by)
        return
    for i, goal in goals.items():
        depth = goal.get("depth_mm")
        if depth is None:
            continue
        if depth < begins:
            reason = f"must be at least {begins:g} mm, where the space begins (space.depth_mm)"
            yield Problem(f"goal[{i}].depth_mm", depth, reason)
        elif depth >= end:
            yield Problem(f"goal[{i}].depth_mm", depth, f"must be less than {end:g} mm, where the space ends ({by})")


def _too_narrow(space: Given, begins: float, end: float, by: str) -> Problem:
    wide = f"must be at least {LEAST_MM:g} mm wide"
    if end < LEAST_MM:
        place = f"begins {end:.4g} mm behind" if end > 0 else "does not begin behind"
        reason = f"{place} the {space['behind']}; the space between them {wide}"
        return Problem("space.in_front_of", space["in_front_of"], reason)
    reason = f"must be at most {end - LEAST_MM:g} mm: the space ends at {end:g} mm ({by}) and {wide}"
    return Problem("space.depth_mm", begins, reason)


def space_end_mm(space: Given, scene: Scene | None) -> tuple[float, str]:
    """Distance from the far face of `behind` to the end of the space, mm, and its cause; infinite without an end."""
    ends = [(np.inf, "")]
    if space.get("deepest_mm") is not None:
        ends.append((space["deepest_mm"], "space.deepest_mm"))
    gap = None if scene is None else _gap_mm(space, scene)
    if gap is not None and "press_mm" in space:
        ends.append((gap + space["press_mm"], f"the {space['in_front_of']}"))
    return min(ends)


def _gap_mm(space: Given, scene: Scene) -> float | None:
    """Distance from the far face of `behind` to the near face of `in_front_of`, mm.

    None if the scene does not have both membranes, or if they are not parallel.
    """
    names = [placed.name for placed in scene.membranes]
    pair = [space.get("behind"), space.get("in_front_of")]
    if pair[0] == pair[1] or any(names.count(str(name)) != 1 for name in pair):
        return None
    one, other = (scene.membranes[names.index(str(name))] for name in pair)
    normals = [np.asarray(placed.inward_normal) for placed in (one, other)]
    n, m = (normal / np.linalg.norm(normal) for normal in normals)
    if n @ m < PARALLEL:
        return None
    return float(n @ (np.asarray(other.point) - np.asarray(one.point)) - one.membrane.thickness) * 1e3


def tip_warnings(file: ExerciseFile, scene: Scene) -> Iterator[Problem]:
    """Warnings with depths in the file's units, for a needle in its direction at the start."""
    tip = _tip_mm(file, scene)
    space = file.space
    end, by = space_end_mm(space.model_dump(), scene)
    ends = [(end, f"the space ends at {end:g} mm, by {by}")]
    for goal in file.goal:
        if isinstance(goal, MostDepth) and goal.at_most_mm is not None:
            ends.append((goal.at_most_mm, f"a goal lets the point come to {goal.at_most_mm:g} mm"))
    end, why = min(ends)
    for i, goal in enumerate(file.goal):
        if not isinstance(goal, Reach | Stay):
            continue
        depth = (goal.depth_mm if isinstance(goal, Reach) else None) or space.depth_mm
        if goal.whole_tip and depth + tip >= end:
            reason = (
                f"the whole tip does not fit at the angle of the start: its end comes to {depth:g} mm only when the "
                f"point is at {depth + tip:.2f} mm, and {why}"
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

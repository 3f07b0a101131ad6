"""The course of an attempt: the target space in the running scene, and what all goals together ask."""

from __future__ import annotations

import math

import numpy as np

from punctura import Scene
from punctura.errors import ConfigurationError, Problem
from punctura.exercise.goals import Course, Reach, Stay
from punctura.exercise.schema import ExerciseFile
from punctura.exercise.space import TargetSpace, place_of

# Illustrative: a thumb that only rests on the plunger feels no loss; a feel_plunger goal sets its own
LEAST_PUSH_N = 0.5


def course_of(file: ExerciseFile, scene: Scene) -> Course:
    """Raises ConfigurationError if the running scene lacks a membrane or the syringe of the exercise."""
    need_membranes(file, scene)
    if scene.syringe is None and judges_plunger(file):
        raise ConfigurationError(
            [Problem("scene", scene.name, "has no syringe, [syringe], whose plunger the exercise judges")]
        )
    return Course(scene, file.start, file.space, space_of(file, scene))


def need_membranes(file: ExerciseFile, scene: Scene) -> None:
    """Raises ConfigurationError if the scene lacks a membrane of the exercise."""
    needed = [file.space.behind, file.space.in_front_of, *(getattr(goal, "membrane", None) for goal in file.goal)]
    names = [placed.name for placed in scene.membranes]
    lacking = list(dict.fromkeys(repr(name) for name in needed if name is not None and name not in names))
    if lacking:
        reason = f"has no membrane {' and no '.join(lacking)}, which the exercise needs; it has {', '.join(names)}"
        raise ConfigurationError([Problem("scene", scene.name, reason)])


def space_of(file: ExerciseFile, scene: Scene) -> TargetSpace:
    """The space in the running scene, which must have its membranes."""
    space = file.space
    reach = next((goal for goal in file.goal if isinstance(goal, Reach)), None)
    stays = [goal for goal in file.goal if isinstance(goal, Stay)]
    stay_whole = any(goal.whole_tip for goal in stays) or (not stays and reach is not None and reach.whole_tip)
    return TargetSpace(
        name=space.name,
        sign=space.sign or "",
        behind=place_of(scene, space.behind),
        in_front_of=None if space.in_front_of is None else place_of(scene, space.in_front_of),
        begins=space.depth_mm * 1e-3,
        ends=np.inf if space.deepest_mm is None else space.deepest_mm * 1e-3,
        press=space.press_mm * 1e-3,
        arrive_whole=stay_whole if reach is None else reach.whole_tip,
        arrive_depth=None if reach is None else reach.depth,
        stay_whole=stay_whole,
    )


def judges_plunger(file: ExerciseFile) -> bool:
    """Whether a goal judges the plunger."""
    return any(goal.needs_syringe for goal in file.goal)


def asked_push(file: ExerciseFile) -> float:
    """The force with which the thumb must push when the point comes out behind the membrane, N."""
    return min((goal.push_N for goal in file.goal if goal.push_N is not None), default=LEAST_PUSH_N)


def asked_angle(file: ExerciseFile) -> float:
    """The angle of entry that the exercise asks for, rad."""
    asked = (goal.entry_deg for goal in file.goal if goal.entry_deg is not None)
    return math.radians(next(asked, file.start.angle_deg))


def felt_membranes(file: ExerciseFile, scene: Scene) -> set[int]:
    """The membranes whose loss of resistance the student must feel, by index."""
    names = {goal.felt_membrane for goal in file.goal if goal.felt_membrane is not None}
    space = file.space
    if space.sign is None if space.sign_is_felt is None else space.sign_is_felt:
        names.add(space.behind)
    return {place_of(scene, name) for name in names}

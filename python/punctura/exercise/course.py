"""What all goals of an exercise ask together, and which of it a device cannot show."""

import math

import numpy as np

from punctura import Scene
from punctura._core import ForceLimits, Syringe, crossing, force_scale, grazing_cosine, law_curve
from punctura.errors import ConfigurationError, Problem
from punctura.exercise.exercise import Exercise, ExerciseFile, start_axis
from punctura.exercise.fields import MOST_PUSH_N
from punctura.exercise.goals import Course, Reach, Stay
from punctura.exercise.losses import LEAST_NEEDED_N, NEEDED_SHARE, needed_drop, remedy
from punctura.exercise.result import Loss, unfelt
from punctura.exercise.ticks import TargetSpace, place_of

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


def expected_losses(exercise: Exercise, scene: Scene, limits: ForceLimits) -> list[Loss]:
    """For each membrane whose loss must be felt: the loss for a needle that goes straight in from the start.

    scene: as the device runs it. limits: in effect on the device. Only the peak limit counts, because how far the
    long-run limit lowers the ceiling depends on the person.
    """
    axis = np.asarray(start_axis(scene, exercise.file.start.angle_deg, exercise.file.start.heading))
    start = np.asarray(exercise.start_position)
    scale = force_scale(scene, limits)
    walls = _walls(scene, start, axis)
    losses = []
    for i in sorted(felt_membranes(exercise.file, scene)):
        _, _, peak, through, _, _ = crossing(scene, i, walls[i][1])
        surface = walls[i][0]
        model = [_friction(scene, walls, surface + depth) for depth in (peak, through)]
        felt = [min(scale * force, limits.max_force) for force in model]
        losses.append(
            Loss(
                membrane=i,
                name=scene.membranes[i].name,
                time=0.0,
                before=felt[0],
                after=felt[1],
                model_before=model[0],
                model_after=model[1],
                force_scale=scale,
                needed=needed_drop(felt[0]),
            )
        )
    return losses


def cannot_show(exercise: Exercise, scene: Scene, limits: ForceLimits) -> str:
    """Why this device cannot show a loss that the exercise needs, and what to do; empty if it can."""
    return " ".join(
        f"This device cannot show the loss of resistance of the {loss.name} ({loss.figures}), so an attempt cannot be "
        f"passed here. {remedy(loss)}"
        for loss in unfelt(expected_losses(exercise, scene, limits))
    )


def thumb_cannot_show(exercise: Exercise, scene: Scene, limits: ForceLimits, thumb: ForceLimits | None) -> str:
    """Why the thumb cannot feel the plunger give way, or how hard it must push; empty if the asked push is enough.

    limits: of the needle's device. thumb: of the second device; None without one. As for the needle, only the peak
    limit counts. At best, the friction of the plunger and the pressure in the space are left when it gives way.
    """
    if scene.syringe is None or not judges_plunger(exercise.file):
        return ""
    if thumb is None:
        return (
            "The thumb is a key here and feels nothing, so the plunger is judged by the model's force. With a second "
            "haptic device under the thumb, it is judged by what the thumb could feel."
        )
    scale, left = force_scale(scene, limits), _left(exercise, scene, scene.syringe.syringe)
    least = max(left + LEAST_NEEDED_N / scale, left / (1 - NEEDED_SHARE))
    before, after = (min(scale * force, thumb.max_force) for force in (MOST_PUSH_N, left))
    if least > MOST_PUSH_N or before - after < needed_drop(before):
        return (
            f"The second device cannot show that the plunger gives way ({before - after:.2f} N at best; "
            f"{needed_drop(before):.2g} N needed), so an attempt cannot be passed here. Set another force_scale in "
            "the scene, or use a stronger second device."
        )
    if least > asked_push(exercise.file):
        return (
            f"At the force scale of {scale:.2g}, push the plunger with clearly more than {least:.1f} N: with less, the "
            "thumb could not feel it give way, and the attempt is not judged as passed."
        )
    return ""


def _left(exercise: Exercise, scene: Scene, syringe: Syringe) -> float:
    """What the plunger resists with in the space, N: its friction, and the pressure there."""
    behind = scene.membranes[place_of(scene, exercise.file.space.behind)].outflow_behind
    return max(0.0, syringe.friction + syringe.area * behind.pressure)


def _walls(scene: Scene, start: np.ndarray, axis: np.ndarray) -> list[tuple[float, float]]:
    """Of each membrane: where the needle meets its surface, m along the needle, and n.b."""
    walls = []
    for placed in scene.membranes:
        normal = np.asarray(placed.inward_normal) / np.linalg.norm(placed.inward_normal)
        cosine = max(float(normal @ axis), grazing_cosine)
        walls.append((float(normal @ (np.asarray(placed.point) - start)) / cosine, cosine))
    return walls


def _friction(scene: Scene, walls: list[tuple[float, float]], depth: float) -> float:
    """The friction of all membranes on a needle that moves in, N. depth: of the point, m along the needle."""
    total = 0.0
    for i, (surface, cosine) in enumerate(walls):
        law = law_curve(scene, i, math.acos(min(1.0, cosine)))
        total += float(np.interp(depth - surface, law["depth"], [-edge for edge in law["lower"]]))
    return total

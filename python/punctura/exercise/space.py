"""The target space of an exercise in a scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from punctura import Scene
from punctura.errors import ConfigurationError, Problem
from punctura.exercise.schema import ExerciseFile, Reach, Stay
from punctura.exercise.ticks import ROUNDING, Flags, JudgedTicks


@dataclass(frozen=True)
class TargetSpace:
    """The space behind one membrane's far face. It ends at another's near face, at a depth, or not at all.

    Distances are along the membranes' normals.
    """

    name: str
    sign: str  # sign of the arrival; may be empty
    behind: int
    in_front_of: int | None
    begins: float  # m behind the far face of `behind`
    ends: float  # the same; infinite without an end at a depth
    press: float  # m, allowed depth of the point in `in_front_of`
    # The definition of arriving and staying, for every measure and sentence.
    arrive_whole: bool  # the whole tip, not only the point
    arrive_depth: float | None  # m, if deeper than the start of the space
    stay_whole: bool

    def holds(self, ticks: JudgedTicks, whole_tip: bool, depth: float | None = None) -> Flags:
        """The ticks in which the point, or the whole tip, is in the space and at least at `depth`, m.

        A needle that the front membrane does not hold is not in the space.
        """
        least = self.begins if depth is None else depth
        past = (ticks.tip_past if whole_tip else ticks.past)[:, self.behind]
        deep = past > 0 if least == 0 and not whole_tip else past >= least - ROUNDING
        return deep & ticks.inside[:, self.behind] & ~self.too_deep(ticks)

    def too_deep(self, ticks: JudgedTicks) -> Flags:
        """The ticks in which the point is behind the space's end, or in an unknown place."""
        flags = np.zeros(len(ticks), dtype=np.bool_)
        if self.in_front_of is not None:
            flags |= ~(ticks.below[:, self.in_front_of] <= self.press)
        if np.isfinite(self.ends):
            flags |= ~(ticks.past[:, self.behind] <= self.ends + ROUNDING)
        return flags

    def arrived(self, ticks: JudgedTicks) -> Flags:
        """The ticks in which the needle meets the `reach` goal, or without one the place of the `stay` goal."""
        return self.holds(ticks, self.arrive_whole, self.arrive_depth)

    @property
    def arrival(self) -> str:
        """The arrival, for sentences such as "0.8 s after ..."."""
        return self.sign or f"you had reached {self.name}"


def need_membranes(file: ExerciseFile, scene: Scene) -> None:
    """Raises ConfigurationError if the running scene does not have all membranes of the exercise."""
    needed = [file.space.behind, file.space.in_front_of, *(getattr(goal, "membrane", None) for goal in file.goal)]
    names = [placed.name for placed in scene.membranes]
    lacking = list(dict.fromkeys(repr(name) for name in needed if name is not None and name not in names))
    if lacking:
        reason = f"has no membrane {' and no '.join(lacking)}, which the exercise needs; it has {', '.join(names)}"
        raise ConfigurationError([Problem("scene", scene.name, reason)])


def place_of(scene: Scene, name: str) -> int:
    """The index of an existing membrane in the running scene."""
    return [placed.name for placed in scene.membranes].index(name)


def space_of(file: ExerciseFile, scene: Scene) -> TargetSpace:
    """The space in the running scene, which must have its membranes."""
    space = file.space
    reach = next((goal for goal in file.goal if isinstance(goal, Reach)), None)
    stay_whole = any(goal.whole_tip for goal in file.goal if isinstance(goal, Stay))
    if not any(isinstance(goal, Stay) for goal in file.goal):
        stay_whole = reach is not None and reach.whole_tip
    return TargetSpace(
        name=space.name,
        sign=space.sign or "",
        behind=place_of(scene, space.behind),
        in_front_of=None if space.in_front_of is None else place_of(scene, space.in_front_of),
        begins=space.depth_mm * 1e-3,
        ends=np.inf if space.deepest_mm is None else space.deepest_mm * 1e-3,
        press=space.press_mm * 1e-3,
        arrive_whole=stay_whole if reach is None else reach.whole_tip,
        arrive_depth=depth_of(reach),
        stay_whole=stay_whole,
    )


def depth_of(goal: Reach | None) -> float | None:
    """The goal's depth behind the far face, m; None if it only asks for the space."""
    return None if goal is None or goal.depth_mm is None else goal.depth_mm * 1e-3

"""The space to be reached, in a scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from punctura import Scene
from punctura.errors import ConfigurationError, Problem
from punctura.exercise.schema import ExerciseFile, Reach, Stay
from punctura.exercise.ticks import ROUNDING, Flags, Ticks


@dataclass(frozen=True)
class TargetSpace:
    """Behind one membrane's far face; it ends in front of another's near face, at a depth, or nowhere.

    All along the membranes' normals.
    """

    name: str
    sign: str  # by which one knows that one is there; may be empty
    behind: int
    in_front_of: int | None
    begins: float  # m behind the far face of `behind`
    ends: float  # likewise; infinite without an end of its own
    press: float  # m that the point may be in `in_front_of`
    # What counts as arriving and as being there, for every measure and sentence.
    arrive_whole: bool  # the whole tip, not the point alone
    arrive_depth: float | None  # m, if it must come deeper than the space begins
    stay_whole: bool

    def holds(self, ticks: Ticks, whole_tip: bool, depth: float | None = None) -> Flags:
        """In which ticks the point, or all of the tip, is in it, at `depth` (m) at least.

        A needle that the front wall does not hold is not in it.
        """
        least = self.begins if depth is None else depth
        past = (ticks.tip_past if whole_tip else ticks.past)[:, self.behind]
        deep = past > 0 if least == 0 and not whole_tip else past >= least - ROUNDING
        return deep & ticks.inside[:, self.behind] & ~self.too_deep(ticks)

    def too_deep(self, ticks: Ticks) -> Flags:
        """In which ticks the point is behind the space's end; also where that is not known."""
        flags = np.zeros(len(ticks), dtype=np.bool_)
        if self.in_front_of is not None:
            flags |= ~(ticks.below[:, self.in_front_of] <= self.press)
        if np.isfinite(self.ends):
            flags |= ~(ticks.past[:, self.behind] <= self.ends + ROUNDING)
        return flags

    def arrived(self, ticks: Ticks) -> Flags:
        """In which ticks the needle is where the exercise's `reach` wants it; without one, where its `stay` does."""
        return self.holds(ticks, self.arrive_whole, self.arrive_depth)

    @property
    def arrival(self) -> str:
        """For sentences: 0.8 s after ..."""
        return self.sign or f"you had reached {self.name}"


def need_membranes(file: ExerciseFile, scene: Scene) -> None:
    """Raises ConfigurationError where the scene that runs lacks membranes that the exercise names."""
    needed = [file.space.behind, file.space.in_front_of, *(getattr(goal, "membrane", None) for goal in file.goal)]
    names = [placed.name for placed in scene.membranes]
    lacking = list(dict.fromkeys(repr(name) for name in needed if name is not None and name not in names))
    if lacking:
        reason = f"has no membrane {' and no '.join(lacking)}, which the exercise needs; it has {', '.join(names)}"
        raise ConfigurationError([Problem("scene", scene.name, reason)])


def place_of(scene: Scene, name: str) -> int:
    """A membrane's number in the scene that runs, which has it."""
    return [placed.name for placed in scene.membranes].index(name)


def space_of(file: ExerciseFile, scene: Scene) -> TargetSpace:
    """The space in the scene that runs, which has its membranes."""
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
    """m behind the far face; None where the goal asks for no more than the space."""
    return None if goal is None or goal.depth_mm is None else goal.depth_mm * 1e-3

"""The space to be reached, in a scene."""

from __future__ import annotations

from dataclasses import dataclass

from punctura import Scene
from punctura.errors import ConfigurationError, Problem
from punctura.exercise.schema import ExerciseFile
from punctura.exercise.ticks import Flags, Ticks


@dataclass(frozen=True)
class TargetSpace:
    """Behind one membrane's far face, in front of another's near face, along their normals."""

    name: str
    sign: str  # by which one knows that one is there; may be empty
    behind: int
    in_front_of: int
    press: float  # m that the point may be in the latter

    def holds(self, ticks: Ticks, whole_tip: bool) -> Flags:
        """In which ticks the point, or all of the tip, is in it. A needle that the front wall does not hold is not."""
        behind = ticks.tip_behind if whole_tip else ticks.point_behind
        return behind[:, self.behind] & ticks.inside[:, self.behind] & ~self.too_deep(ticks)

    def too_deep(self, ticks: Ticks) -> Flags:
        """In which ticks the point is in the membrane at the space's end; also where that is not known."""
        return ~(ticks.below[:, self.in_front_of] <= self.press)

    @property
    def arrival(self) -> str:
        """For sentences: 0.8 s after ..."""
        return self.sign or f"you had reached {self.name}"


def place_of(scene: Scene, name: str) -> int:
    """A membrane's number in the scene that runs. Raises ConfigurationError."""
    names = [placed.name for placed in scene.membranes]
    if name not in names:
        known = ", ".join(names)
        problem = Problem("scene", scene.name, f"has no membrane {name!r}, which the exercise needs; it has {known}")
        raise ConfigurationError([problem])
    return names.index(name)


def space_of(file: ExerciseFile, scene: Scene) -> TargetSpace:
    """Raises ConfigurationError."""
    space = file.space
    behind, in_front_of = place_of(scene, space.behind), place_of(scene, space.in_front_of)
    return TargetSpace(space.name, space.sign or "", behind, in_front_of, space.press_mm * 1e-3)

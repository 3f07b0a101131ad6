"""The target space of an exercise in a scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from punctura import Scene
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


def place_of(scene: Scene, name: str) -> int:
    """The index of an existing membrane in the running scene."""
    return [placed.name for placed in scene.membranes].index(name)

"""What a task asks for: a space behind a wall, in which the needle must come to rest."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from punctura import Scene
from punctura._core import crossing
from punctura.gym.population import Vary

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Task:
    """A task. Lengths in m, along the needle where not said otherwise; the skin is at the origin of the scene."""

    scene: str  # a ready scene
    wall: int  # the membrane behind which the space begins
    whole_tip: bool  # the whole slanted face of the tip must be in the space; otherwise its point
    next_wall: int | None  # the membrane that ends the space
    room: float  # length of the space behind the wall, if no membrane ends it
    angle: float  # of the needle to the skin, rad
    distance: tuple[float, float]  # from the tip to the skin at the start, least and most
    vary: tuple[Vary, ...] = field(default=())  # the population of the task
    fastest: float = 0.02  # m/s, of the hand for the action 1
    decision: float = 0.02  # s from one action to the next
    still: float = 0.002  # m/s: slower than that is at rest
    hold: float = 0.5  # s at rest in the space
    press: float = 2e-4  # m: the next wall may be pressed in by that
    time_limit: float = 20.0  # s

    @property
    def axis(self) -> tuple[float, float, float]:
        """The direction of the needle."""
        return math.cos(self.angle), -math.sin(self.angle), 0.0

    def space(self, scene: Scene) -> tuple[float, float]:
        """(begin, end) of the space for the tip, as depth behind the surface of the wall. end is inf if a membrane
        ends the space."""
        normal = np.array(scene.membranes[self.wall].inward_normal)
        cosine = float(normal @ self.axis / np.linalg.norm(normal))
        _, far_face, _, through, _, _ = crossing(scene, self.wall, cosine)
        begin = through if self.whole_tip else far_face
        return begin, begin + self.room if self.next_wall is None else math.inf

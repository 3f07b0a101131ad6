"""The ready tasks, and their names for gymnasium.make and gymnasium.make_vec.

The spread of their populations is illustrative, except where a source is named.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from math import inf, radians
from types import MappingProxyType

import gymnasium
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


_MM = 1e-3


def _firmness(*membranes: int) -> tuple[Vary, ...]:
    """Stiffness and precompression of each membrane vary together; its friction alone."""
    return tuple(
        vary
        for i in membranes
        for vary in (
            Vary([f"membrane[{i}].stiffness", f"membrane[{i}].precompression"], 0.8, 1.25),
            Vary([f"membrane[{i}].friction"], 0.9, 1.1),
        )
    )


TASKS = MappingProxyType(
    {
        # The depth of veins of the elbow fold spreads by more than a millimetre (venipuncture.toml names the source of
        # the mean). Along the needle, at 30 degrees, that is twice as much; the space for the whole tip has 1.9 mm.
        "Venipuncture": Task(
            scene="venipuncture", wall=1, whole_tip=True, next_wall=2, room=inf, angle=radians(30),
            distance=(4 * _MM, 8 * _MM),
            vary=(
                Vary(["membrane[1].point[1]", "membrane[2].point[1]"], -1.5 * _MM, 1.5 * _MM, "shift"),
                *_firmness(0, 1, 2),
            ),
        ),
        # The skin is a few millimetres nearer to the ligament in one person than in another: the ligament in front of
        # the flavum takes up the difference, so that no gap opens.
        "Epidural": Task(
            scene="epidural", wall=4, whole_tip=False, next_wall=5, room=inf, angle=radians(90),
            distance=(4 * _MM, 8 * _MM), time_limit=30,
            vary=(
                Vary({"membrane[3].thickness": 1, "membrane[4].point[1]": -1, "membrane[5].point[1]": -1},
                     -5 * _MM, 5 * _MM, "shift"),
                *_firmness(0, 1, 2, 3, 4, 5),
            ),
        ),
        "StopAfterPop": Task(
            scene="k06-fig10", wall=0, whole_tip=True, next_wall=None, room=2.5 * _MM, angle=radians(90),
            distance=(2 * _MM, 12 * _MM), vary=_firmness(0),
        ),
    }
)  # fmt: skip


def register() -> None:
    """Registers punctura/NAME-v0 for each task. Does nothing for a name that is registered."""
    for name in TASKS:
        if f"punctura/{name}-v0" not in gymnasium.registry:
            gymnasium.register(
                f"punctura/{name}-v0",
                entry_point="punctura.gym.env:NeedleEnv",
                vector_entry_point="punctura.gym.env:NeedleVectorEnv",
                kwargs={"task": name},
            )

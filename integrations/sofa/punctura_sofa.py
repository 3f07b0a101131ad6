"""Punctura in SOFA: a controller of SofaPython3 that gives the force of a scene to a rigid needle.

It needs SOFA with SofaPython3, and punctura in its Python. example.py shows a whole scene of SOFA.
"""

from typing import Any

import numpy as np
import Sofa
from punctura import Scene, load_scene
from punctura.poses import PosedNeedle


def turned(quaternion: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """A vector (3,) turned by a quaternion x, y, z, w of length 1."""
    u, w = quaternion[:3], quaternion[3]
    return vector + 2 * np.cross(u, np.cross(u, vector) + w * vector)


class PuncturaController(Sofa.Core.Controller):
    """Before each step of SOFA, sets the force of the membranes on the needle.

    needle: MechanicalObject of template Rigid3d; its first body is the needle. field: ConstantForceField on it, with
    one index. scene: a Scene, a scene file or a ready scene by name; its frame is that of `tissue`, or of the world.
    tissue: MechanicalObject Rigid3d that the membranes move with, or None. tissue_field: its ConstantForceField, which
    gets the opposite force. tip (3,), axis (3,): of the needle in its own frame, m. metres_per_unit: of SOFA's world.

    Between two steps the needle moves in a straight line, with all ticks of the scene's rate. When SOFA's time goes
    back, the needle starts anew.
    """

    def __init__(
        self, *args: Any, needle: Any, field: Any, scene: Scene | str, tissue: Any = None, tissue_field: Any = None,
        tip: tuple[float, float, float] = (0, 0, 0), axis: tuple[float, float, float] = (0, 0, 1),
        metres_per_unit: float = 1.0, **kwargs: Any,
    ) -> None:  # fmt: skip
        super().__init__(*args, **kwargs)
        self.needle, self.field, self.tissue, self.tissue_field = needle, field, tissue, tissue_field
        self.tip, self.axis, self.metres = np.array(tip, float), np.array(axis, float), metres_per_unit
        self.model = PosedNeedle(scene if isinstance(scene, Scene) else load_scene(scene))
        self.force = np.zeros(3)

    def onAnimateBeginEvent(self, event: dict[str, float]) -> None:
        time = float(self.needle.getContext().time.value)  # goes back when the simulation is reset
        body = np.array(self.needle.position.value[0], float)
        arm = turned(body[3:], self.tip / self.metres)
        place = self._place()
        into = np.array([-1, -1, -1, 1]) * place[3:]  # the inverse turn
        tip = turned(into, body[:3] + arm - place[:3]) * self.metres
        force = self.model.move(time, tip, turned(into, turned(body[3:], self.axis)))
        self.force = turned(place[3:], force)
        give(self.field, self.force / self.metres, arm)
        if self.tissue_field is not None:
            give(self.tissue_field, -self.force / self.metres, body[:3] + arm - place[:3])

    def _place(self) -> np.ndarray:
        if self.tissue is None:
            return np.array([0, 0, 0, 0, 0, 0, 1.0])
        return np.array(self.tissue.position.value[0], float)


def give(field: Any, force: np.ndarray, arm: np.ndarray) -> None:
    """Sets the force and its torque about the body's centre."""
    with field.forces.writeable() as forces:
        forces[0] = [*force, *np.cross(arm, force)]

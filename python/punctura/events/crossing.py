"""The characteristic depths of the crossing of a membrane, from its law."""

from __future__ import annotations

from typing import NamedTuple

from punctura import Scene, _core


class Crossing(NamedTuple):
    """The steps of a needle through a membrane, as depths of the tip behind the surface along the needle, m."""

    cos_beta: float  # n.b, with b the needle's direction at entry
    far_face: float  # the point of the tip leaves the far face: U
    peak: float  # the resistance -Phi_I is largest
    through: float  # the whole slanted face has left the far face; from here only the shaft has friction: X + U
    again: float  # a tip that is pulled back to this depth can pop again
    shaft: float  # N, friction of the shaft alone: F / n.b


def crossing(scene: Scene, membrane: int, cos_beta: float) -> Crossing:
    """The crossing of one membrane of a scene, by its index, for a needle with n.b = cos_beta. Raises IndexError."""
    return Crossing(*_core.crossing(scene, membrane, cos_beta))

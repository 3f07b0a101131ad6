"""The depths at which the crossing of a membrane turns, from its law."""

from __future__ import annotations

from typing import NamedTuple

from punctura import Scene, _core


class Crossing(NamedTuple):
    """Depths along the needle, m."""

    cos_beta: float  # n.b, of the needle's direction at entry
    far_face: float  # the tip's point comes out behind: U
    peak: float  # the resistance is largest: where Phi_I is
    through: float  # the slanted face is out behind, too; from here on only the shaft rubs: X + U
    again: float  # a tip that has come back to here can pop again
    shaft: float  # N, of the shaft alone: F / n.b


def crossing(scene: Scene, membrane: int, cos_beta: float) -> Crossing:
    """Of one membrane of a scene, by its number, for a needle with n.b = cos_beta. Raises IndexError."""
    return Crossing(*_core.crossing(scene, membrane, cos_beta))

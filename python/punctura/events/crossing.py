"""The depths at which the crossing of a membrane turns, from its law."""

from __future__ import annotations

import math
from typing import NamedTuple

from punctura import Scene, ThickLaw

STEEPEST = math.cos(math.radians(80))  # a flatter needle grazes and is given no force: docs/errata.md, E6
BACK = 0.1  # of the tip's length that it must come back before the peak for another pop to count


class Crossing(NamedTuple):
    """Depths along the needle, m."""

    cos_beta: float  # n.b, of the needle's direction at entry
    far_face: float  # the tip's point comes out behind: U
    peak: float  # the resistance is largest: where Phi_I is
    through: float  # the slanted face is out behind, too; from here on only the shaft rubs: X + U
    again: float  # a tip that has come back to here can pop again
    shaft: float  # N, of the shaft alone: F / n.b


def crossing(scene: Scene, membrane: int, cos_beta: float) -> Crossing:
    """Of one membrane of a scene for a needle with n.b = cos_beta. K06 (15), (17), (18).

    Phi_I grows up to max(U, X). Behind it, as the slanted face comes out, it may still grow a little: there its slope
    is A_I (m - X - Q) + F at first, with m = min(U, X), and falls with A_I.
    """
    cos_beta = min(1.0, max(STEEPEST, cos_beta)) if math.isfinite(cos_beta) else 1.0
    law = ThickLaw(scene.needle, scene.membranes[membrane].membrane, math.acos(cos_beta))
    still = min(law.U, law.X) - law.X - law.Q + law.F / law.A_I
    peak = max(law.U, law.X) + max(0.0, still)
    return Crossing(cos_beta, law.U, peak, law.X + law.U, peak - BACK * law.X, law.F / cos_beta)

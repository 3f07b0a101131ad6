"""Curves of Phi_I and Phi_O for the page, for the present direction of the needle."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from punctura import Scene, _core
from punctura._core import obliquities
from punctura.studio.wire.common import LawCurve

__all__ = ["TURN", "Vector", "law_curves", "obliquities"]

TURN = math.radians(0.5)  # smaller changes of direction do not update the curves

Vector = npt.NDArray[np.float64]


def law_curves(scene: Scene, obliquities: npt.ArrayLike) -> list[LawCurve]:
    """One curve per membrane. obliquities (m,): rad."""
    angles = np.asarray(obliquities, float)
    return [LawCurve(**_core.law_curve(scene, i, float(angle))) for i, angle in enumerate(angles)]

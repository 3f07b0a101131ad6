"""Phi_I and Phi_O as curves to draw, for the direction that the needle has now."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from punctura import Scene, _core
from punctura._core import obliquities
from punctura.studio.wire.common import LawCurve

__all__ = ["TURN", "Vector", "law_curves", "obliquities"]

TURN = math.radians(0.5)  # less than this is not drawn anew

Vector = npt.NDArray[np.float64]


def law_curves(scene: Scene, obliquities: npt.ArrayLike) -> list[LawCurve]:
    """One of each membrane. obliquities (m,): rad."""
    angles = np.asarray(obliquities, float)
    return [LawCurve(**_core.law_curve(scene, i, float(angle))) for i, angle in enumerate(angles)]

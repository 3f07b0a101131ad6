"""Phi_I and Phi_O as curves to draw, for the direction that the needle has now."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from punctura import Scene, _core
from punctura.studio.wire.common import LawCurve

TURN = math.radians(0.5)  # less than this is not drawn anew

Vector = npt.NDArray[np.float64]


def law_curves(scene: Scene, obliquities: npt.ArrayLike) -> list[LawCurve]:
    """One of each membrane. obliquities (m,): rad."""
    angles = np.asarray(obliquities, float)
    return [LawCurve(**_core.law_curve(scene, i, float(angle))) for i, angle in enumerate(angles)]


def obliquities(scene: Scene, axis: Vector, entered: Vector | None = None) -> Vector:
    """Angle of the needle to each membrane's inward normal, rad, at most 85 degrees.

    axis (3,): of the stylus. entered (m, 3): the direction of each membrane that the needle is in; NaN in the others.
    """
    return _core.drawn_obliquities(scene, axis, entered)

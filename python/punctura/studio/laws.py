"""Phi_I and Phi_O as curves to draw, for the direction that the needle has now."""

from __future__ import annotations

import itertools
import math

import numpy as np
import numpy.typing as npt

from punctura import Scene, ThickLaw
from punctura.studio.wire.common import LawCurve

POINTS = 16  # between two break points: a quadratic piece then looks smooth
BEFORE, BEHIND = 0.1, 0.3  # of the way through, that is drawn outside it
STEEPEST = math.radians(85)  # beyond, 1 / cos(obliquity) is of no use to the eye
TURN = math.radians(0.5)  # less than this is not drawn anew

Vector = npt.NDArray[np.float64]


def law_curves(scene: Scene, obliquities: npt.ArrayLike) -> list[LawCurve]:
    """One of each membrane. obliquities (m,): rad."""
    return [_curve(scene, i, float(beta)) for i, beta in enumerate(np.asarray(obliquities, float))]


def obliquities(scene: Scene, axis: Vector, entered: Vector | None = None) -> Vector:
    """Angle of the needle to each membrane's inward normal, rad, at most STEEPEST.

    axis (3,): of the stylus. entered (m, 3): the direction of each membrane that the needle is in; NaN in the others.
    """
    angles = np.zeros(len(scene.membranes))
    for i, placed in enumerate(scene.membranes):
        normal = np.array(placed.inward_normal)
        direction = normal if scene.direction == "motion" else axis
        if entered is not None and i < len(entered) and np.isfinite(entered[i]).all():
            direction = entered[i]
        cosine = float(direction @ normal) / float(np.linalg.norm(normal) * np.linalg.norm(direction) or math.nan)
        angles[i] = min(math.acos(min(1.0, max(-1.0, cosine))), STEEPEST) if math.isfinite(cosine) else 0.0
    return angles


def _curve(scene: Scene, i: int, obliquity: float) -> LawCurve:
    placed = scene.membranes[i]
    law = ThickLaw(scene.needle, placed.membrane, obliquity)
    through = law.X + law.U
    depth = _depths(sorted((0.0, min(law.X, law.U), max(law.X, law.U), through)))
    lower, upper = law.bounds(depth)
    return LawCurve(
        name=placed.name,
        obliquity=obliquity,
        tip_length=law.X,
        through=through,
        depth=depth.tolist(),
        lower=lower.tolist(),
        upper=upper.tolist(),
    )


def _depths(breaks: list[float]) -> Vector:
    """Both sides of each break are there, so that a drop is drawn as one."""
    span = breaks[-1]
    parts = [np.array([-BEFORE * span, (1 + BEHIND) * span])]
    for a, b in itertools.pairwise(breaks):
        parts.append(np.linspace(a, b, POINTS))
    for b in breaks:
        parts.append(np.array([np.nextafter(b, -1.0), b, np.nextafter(b, 1.0)]))
    return np.unique(np.concatenate(parts))

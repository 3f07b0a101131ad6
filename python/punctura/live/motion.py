"""What the hand at a simulated device does when nobody tells it: strokes through everything in the scene."""

from __future__ import annotations

import math

import numpy as np

from punctura import Hand, Scene, Strokes
from punctura._core import law_curve

CLEARANCE = 5e-3  # m in front of the first surface, where force may be switched on
BEYOND = 3e-3  # m of shaft behind the last wall, and for the friction of the device itself
STEEPEST = math.radians(80)  # a wall that lies almost along the strokes cannot be gone through that way

Array = np.ndarray[tuple[int, ...], np.dtype[np.float64]]
Triple = tuple[float, float, float]


def stroke_ends(scene: Scene) -> tuple[Triple, Triple]:
    """Where the hand's strokes through the scene begin and end, m: in front of all membranes, and beyond the last.

    Beyond it by as much as the walls' greatest forces F hold the tip back: each its own by F / K in the coupling, and
    all together by sum(F) / k in the hand's spring k, so that the tip itself comes out behind.
    """
    first = np.array(scene.membranes[0].point)
    inward = _unit(scene.membranes[0].inward_normal)
    walls = [_wall(scene, i, first, inward) for i in range(len(scene.membranes))]
    held_back = sum(peak for _, _, peak in walls) / Hand().stiffness
    start = min(begin for begin, _, _ in walls) - CLEARANCE
    end = max(begin + through + peak / scene.coupling.stiffness for begin, through, peak in walls) + held_back + BEYOND
    return _triple(first + start * inward), _triple(first + end * inward)


def _wall(scene: Scene, i: int, origin: Array, way: Array) -> tuple[float, float, float]:
    """Along a way: where its surface is, how far it is through, m; and its greatest force, N."""
    placed = scene.membranes[i]
    normal = _unit(placed.inward_normal)
    if normal @ way < 0:  # a back wall may be written with its normal the other way: it is met from its far side
        normal = -normal
    cosine = max(float(normal @ way), math.cos(STEEPEST))
    law = law_curve(scene, i, math.acos(min(1.0, cosine)))
    peak = max(-min(law["lower"]), max(law["upper"]))
    return float((np.array(placed.point) - origin) @ normal) / cosine, law["through"], peak


def strokes_through(scene: Scene, count: int = 1000, duration: float = 2.0) -> Strokes:
    """Strokes along the first membrane's normal, from in front of all membranes to behind the last."""
    start, end = stroke_ends(scene)
    return Strokes(start, end, count=count, duration=duration, rest=0.7, variation=0.05)


def _unit(v: Triple | list[float]) -> Array:
    unit: Array = np.array(v) / np.linalg.norm(v)
    return unit


def _triple(v: Array) -> Triple:
    return float(v[0]), float(v[1]), float(v[2])

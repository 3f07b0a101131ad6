"""The default motion of a simulated hand: strokes through all membranes of the scene."""

from __future__ import annotations

import math

import numpy as np

from punctura import Hand, Scene, Strokes
from punctura._core import grazing_cosine, law_curve

CLEARANCE = 5e-3  # m in front of the first surface, where the force may begin
BEYOND = 3e-3  # m of shaft behind the last wall, as a margin for the device's own friction


Array = np.ndarray[tuple[int, ...], np.dtype[np.float64]]
Triple = tuple[float, float, float]


def stroke_ends(scene: Scene) -> tuple[Triple, Triple]:
    """The two ends of the hand's strokes, m: in front of all membranes, and behind the last.

    The far end adds the lag of the tip under the walls' greatest forces F: F / K of each in the coupling, and
    sum(F) / k in the hand's spring k. So the tip itself comes out behind.
    """
    first = np.array(scene.membranes[0].point)
    inward = _unit(scene.membranes[0].inward_normal)
    walls = [_wall(scene, i, first, inward) for i in range(len(scene.membranes))]
    held_back = sum(peak for _, _, peak in walls) / Hand().stiffness
    start = min(begin for begin, _, _ in walls) - CLEARANCE
    end = max(begin + through + peak / scene.coupling.stiffness for begin, through, peak in walls) + held_back + BEYOND
    return _triple(first + start * inward), _triple(first + end * inward)


def _wall(scene: Scene, i: int, origin: Array, way: Array) -> tuple[float, float, float]:
    """A wall along the stroke: place of its surface, length through it, m; its greatest force, N."""
    placed = scene.membranes[i]
    normal = _unit(placed.inward_normal)
    if normal @ way < 0:  # a back wall may have the opposite normal: the needle meets its far side
        normal = -normal
    cosine = max(float(normal @ way), grazing_cosine)  # at a flatter angle the core refuses the entry
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

"""What the hand at a simulated device does when nobody tells it: strokes through everything in the scene."""

from __future__ import annotations

import math

import numpy as np

from punctura import Scene, Strokes

CLEARANCE = 5e-3  # m in front of the first surface, where force may be switched on
BEYOND = 3e-3  # m of shaft behind the last wall


Triple = tuple[float, float, float]


def stroke_ends(scene: Scene) -> tuple[Triple, Triple]:
    """Where strokes through the scene begin and end, m: in front of all membranes, and behind the last."""
    first = scene.membranes[0]
    inward = np.array(first.inward_normal) / np.linalg.norm(first.inward_normal)
    depths, ends = [], []
    for placed in scene.membranes:
        depth = float((np.array(placed.point) - np.array(first.point)) @ inward)
        tip = scene.needle.diameter / math.tan(scene.needle.tip_angle)
        depths.append(depth)
        ends.append(depth + tip + placed.membrane.thickness)
    start = np.array(first.point) + (min(depths) - CLEARANCE) * inward
    end = np.array(first.point) + (max(ends) + BEYOND) * inward
    return _triple(start), _triple(end)


def strokes_through(scene: Scene, count: int = 1000, duration: float = 2.0) -> Strokes:
    """Strokes along the first membrane's normal, from in front of all membranes to behind the last.

    The hand wants to go farther than the tip shall come, by what the stiffest wall's force stretches it.
    """
    start, end = stroke_ends(scene)
    return Strokes(start, end, count=count, duration=duration, rest=0.7, variation=0.05)


def _triple(v: np.ndarray) -> Triple:
    return float(v[0]), float(v[1]), float(v[2])

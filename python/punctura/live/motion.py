"""The default motion of a simulated hand: strokes through all membranes of the scene."""

from __future__ import annotations

from punctura import Scene
from punctura._core import Strokes, stroke_ends

__all__ = ["stroke_ends", "strokes_through"]


def strokes_through(scene: Scene, count: int = 1000, duration: float = 2.0) -> Strokes:
    """Strokes along the first membrane's normal, from in front of all membranes to behind the last."""
    start, end = stroke_ends(scene)
    return Strokes(start, end, count=count, duration=duration, rest=0.7, variation=0.05)

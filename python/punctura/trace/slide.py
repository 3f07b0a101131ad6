"""How the slide of a rig moves, and what friction that ends in a rest adds to the force."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from punctura.trace.air import smooth
from punctura.trace.friction import Slide
from punctura.trace.segment import segment
from punctura.trace.trace import Trace
from punctura.trace.turns import noise_of

Array = NDArray[np.float64]

NOISES = 6.0  # of the depth: so far it must go back to turn


def ending(trace: Trace) -> tuple[Array, Array]:
    """What friction of 1 N that ends in a rest adds to the force (n, 1), or each way by itself (n, 2).

    It is a mean of three samples, because no stroke is known better; at both ends of a rest, the drive moves or brakes.
    """
    found = np.zeros(len(trace))
    for stroke in segment(trace).strokes:
        if stroke.kind != "hold":
            found[max(stroke.start - 1, 0) : stroke.end + 1] = 1.0 if stroke.kind == "in" else -1.0
    each = np.column_stack((smooth(np.maximum(found, 0.0), 3), smooth(np.minimum(found, 0.0), 3)))
    return smooth(found, 3)[:, None], each


def slide_of(trace: Trace) -> Slide:
    play = NOISES * noise_of(trace.depth)
    if play == 0:
        steps = np.diff(trace.depth, prepend=trace.depth[0])
    else:
        at, quiet = float(trace.depth[0]), np.empty(len(trace))
        for i, depth in enumerate(trace.depth.tolist()):
            at = min(max(at, depth - play / 2), depth + play / 2)
            quiet[i] = at
        steps = np.diff(quiet, prepend=quiet[0])
    moved = np.flatnonzero(steps)
    signs = np.sign(steps[moved])
    first = np.flatnonzero(np.diff(signs, prepend=0.0)) if len(moved) else np.empty(0, np.int64)
    way = np.cumsum(np.abs(steps))
    return Slide(way, way[moved[first] - 1], signs[first])

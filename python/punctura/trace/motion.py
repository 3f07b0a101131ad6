"""The depth of a force sensor on a robot that moves at stated speeds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from punctura.trace.trace import Finding

Array = NDArray[np.float64]
Speeds = Sequence[tuple[float, float]]  # from which time on (s since the first sample), how fast (m/s, inwards)


def depth_from(speeds: Speeds, time: Array) -> Array:
    """The depth (n,), m from the first sample, at the times (n,), s."""
    since = time - time[0]
    starts = np.array([start for start, _ in speeds])
    passed = np.maximum(0.0, np.minimum(since[:, None], np.append(starts[1:], np.inf)) - starts)
    depth: Array = passed @ np.array([speed for _, speed in speeds])
    return depth


def about_speed(speeds: Speeds, force: Array) -> Finding:
    """Says that the depth was not measured, and whether the force (n,), N, looks as if the needle had turned."""
    text = "the depth follows from the stated speed; it was not measured"
    level = force - np.median(force[: max(1, len(force) // 50)])
    peak = level[np.argmax(np.abs(level))]
    if len(speeds) == 1 and float(np.mean(level * np.sign(peak) < -0.1 * abs(peak))) > 0.05:
        text += ". The force changes its sign, as if the needle turned: state when it stopped and turned "
        text += "(--speed-mm-per-s 4,0@4,-4@5: 4 mm/s, from 4 s on 0, from 5 s on -4 mm/s)"
    return Finding("depth_from_speed", text)

"""Touch, pop and out as docs/events.md defines them, in one plain loop over the ticks of one membrane."""

import math

import numpy as np
from punctura import Phase

INSIDE = (Phase.sticking.value, Phase.sliding_in.value, Phase.sliding_out.value)
CLEAR = 0.25e-3  # m


def turns(needle, membrane, cos_beta):
    """(depth of the peak, depth of the pop, depth of readiness, friction of the shaft). K06 (15), (17), (18)."""
    mu, t = membrane.friction, math.tan(needle.tip_angle)
    X, U = needle.diameter / t, membrane.thickness / cos_beta
    growth = membrane.stiffness * t * (2 * mu + (1 - mu * mu) * t) / (1 - mu * t)
    Q = membrane.precompression / (membrane.stiffness * t)
    F = 2 * mu * (membrane.stiffness * needle.diameter + membrane.precompression)
    peak = max(U, X) + max(0.0, min(U, X) - X - Q + F / growth)
    return peak, X + U, peak - X / 10, F / cos_beta


def cosine(normal, *directions):
    """Cosine between the normal and the first valid direction. Angles are limited to 80 degrees."""
    for b in directions:
        length = math.sqrt(sum(x * x for x in b))
        if math.isfinite(length) and length > 0:
            found = sum(x * n for x, n in zip(b, normal, strict=True)) / length / np.linalg.norm(normal)
            return min(1.0, max(math.cos(math.radians(80)), found))
    return 1.0


def events(needle, placed, phase, depth, force, lower, direction, axis):
    """(tick, what, force before, force after) of one membrane. Columns: one row a tick."""
    found = []
    touched = False
    law = None  # (peak, through, again, shaft) while inside
    largest = None  # resistance since the tip was ready for a pop; None while it is not
    for k in range(len(depth)):
        if not math.isfinite(depth[k]):
            continue
        if phase[k] not in INSIDE:
            law = None
            if phase[k] == Phase.outside.value and touched and depth[k] <= -CLEAR:
                touched = False
                found.append((k, "out", 0.0, 0.0))
            continue
        if law is None:
            law = turns(needle, placed.membrane, cosine(placed.inward_normal, direction[k], axis[k]))
            largest = 0.0
        if not touched:
            touched = True
            found.append((k, "touch", 0.0, 0.0))
        _, through, again, shaft = law
        if largest is None and depth[k] <= again:
            largest = 0.0
        if largest is None:
            continue
        if -force[k] > largest:
            largest = -force[k]
        if depth[k] >= through:
            after = next((-x for x in (lower[k], force[k]) if math.isfinite(x)), shaft)
            found.append((k, "pop", largest, after))
            largest = None
    return found

"""Fits again from random places around the best end: with several walls, one of many optima is the best."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from punctura.identify.fit import Fit, shortly
from punctura.identify.parameters import UNITS, kind_of
from punctura.identify.pops_moved import noise_limit
from punctura.trace import TraceError

Array = NDArray[np.float64]

MOST, IDLE = 120, 30  # hops; and hops without a better end, after which there are no more
SIZES = (0.3, 1.0, 2.0)  # of a hop
MOVED = (0.2, 0.5, 1.0)  # shares of the parameters that a hop moves
SHORT, PROMISING = 12, 1.5  # evaluations, after which a search goes on only if its squares are within this factor
GAIN = 1e-3  # of the squares, that counts as a better end


def with_hops(found: Fit) -> Fit:
    """The fit, or a better one that begins near it, at random places. The places are the same in each run.

    Only for several walls: for one, the convex start finds the optimum.
    """
    enough = noise_limit(found.misfit.trace)
    if len(found.parameters.membranes) < 2 or found.weighted_rmse < enough or found.hopped:
        return found
    rng = np.random.default_rng(0)
    best, idle = found, 0
    for _ in range(MOST):
        end = _hopped(best, rng)
        idle = 0 if end is not None and end.sse < (1 - GAIN) * best.sse else idle + 1
        if end is not None and end.sse < best.sse:
            best = end
        if idle == IDLE or best.weighted_rmse < enough:
            break
    return replace(best, hopped=True)


def _hopped(best: Fit, rng: np.random.Generator) -> Fit | None:
    free = best.free
    moves = rng.choice(SIZES) * rng.normal(size=len(best.u)) * (rng.random(len(best.u)) < rng.choice(MOVED))
    margin = 1e-6 * np.minimum(free.high - free.low, 1.0)
    u = np.clip(best.u + moves * _sizes(best), free.low + margin, free.high - margin)
    try:
        return shortly(best.misfit, free, u, SHORT, PROMISING * best.sse)
    except (TraceError, FloatingPointError):
        return None


def _sizes(best: Fit) -> Array:
    """How far each coordinate moves in a hop of size 1."""
    free, trace = best.free, best.misfit.trace
    way, force = float(np.ptp(trace.depth)), float(np.ptp(trace.force))
    values = free.values(best.u)
    spring = best.parameters.get("coupling_stiffness")
    ranges = {
        "surface": 0.04 * way,
        "growth": 1.0 / best.parameters.needle.diameter,
        "offset": 0.01 * force,
        "set": 0.1,
        "tail_floor": 0.15,
        "relaxation_1_stiffness": 0.1 * spring,
        "relaxation_2_stiffness": 0.1 * spring,
    }
    sizes = []
    for j, name in enumerate(free.names):
        kind = kind_of(name)
        other = 0.7 if free.logarithmic(j) else 0.3 * abs(values[j]) + (0.04 * force if UNITS[kind] == "N" else 0.0)
        sizes.append(ranges.get(kind, other))
    return np.array(sizes)

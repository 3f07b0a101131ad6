"""Moves that least squares do not make: a pop over a sample, a contact with a jump, a hop to another optimum."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from punctura.identify.fit import Fit, best_of, fit, shortly
from punctura.identify.parameters import UNITS, kind_of
from punctura.trace import Trace, TraceError
from punctura.trace.turns import noise_of

ENOUGH = 1.02  # of the noise from sample to sample
ROUNDS = 3  # of moved pops
SHIFTS = (-2.0, -1.0, -0.5, -0.25, -0.1, 0.0, 0.1, 0.25, 0.5, 1.0, 2.0)  # samples
THICKNESSES = (-1.4, -0.7, 0.0, 0.7)  # logarithms of factors


def noise_limit(trace: Trace) -> float:
    """An rms error that is noise, N: no model leaves much less."""
    return ENOUGH * noise_of(trace.force)


def with_pops_moved(found: Fit) -> Fit:
    """The fit, or a better one that starts with pops moved by up to two samples, and walls thinner or thicker.

    Least squares do not jump over a sample.
    """
    for _ in range(ROUNDS):
        moved = _moved(found)
        if not moved.sse < 0.999 * found.sse:
            return moved
        found = moved
    return found


def _moved(found: Fit) -> Fit:
    trace, free, u, least = found.misfit.trace, found.free, found.u.copy(), found.sse
    if found.weighted_rmse < noise_limit(trace):
        return found
    sample = float(np.median(np.abs(np.diff(trace.depth))))
    for k, name in enumerate(free.names):
        if not name.endswith("surface"):
            continue
        own = [j for j, other in enumerate(free.names) if other == name.replace("surface", "thickness")]
        here = u.copy()
        for shift, thicker in product(SHIFTS, THICKNESSES if own else (0.0,)):
            trial = here.copy()
            trial[k] += shift * sample
            trial[own] += thicker
            trial = np.clip(trial, free.low, free.high)
            left = found.misfit.residuals(free, trial)
            if left @ left < least:
                u, least = trial, float(left @ left)
    if least == found.sse:
        return found
    try:
        moved = fit(found.misfit, free.names, free.parameters(u))
    except TraceError:
        return found
    return replace(moved, others=found.others) if moved.sse < found.sse else found


SHARES = (0.1, 0.2, 0.4, 0.8)  # of the greatest force of the trace, as precompressions


def with_contacts_moved(found: Fit) -> Fit:
    """The fit, or a better one that starts with another precompression of a wall that pops behind the trace.

    The force jumps at a contact, by a part of the precompression. A search from an early contact without a jump does
    not find a later contact with one, because that moves the jump over samples. Ends that explain the trace nearly as
    well are among `others`.
    """
    free, ends = found.free, [found]
    popped = {k for k, _ in free.walls}
    for k, name in enumerate(free.names):
        precompression = name.replace(".surface", ".precompression")
        if not name.endswith(".surface") or k in popped or precompression not in free.names:
            continue
        here = min(ends, key=lambda end: end.sse).parameters
        if here.get(name) < found.misfit.trace.depth.min():
            continue  # the contact is not seen
        for share in SHARES:
            start = here.with_values({precompression: share * float(found.misfit.trace.force.max())})
            try:
                ends.append(fit(found.misfit, free.names, start))
            except TraceError:
                continue
    return best_of(ends)


Array = NDArray[np.float64]

MOST, IDLE = 120, 30  # hops; and hops without a better end, after which there are no more
FEW = 10  # the same, while the model is not chosen yet
SIZES = (0.3, 1.0, 2.0)  # of a hop
MOVED = (0.2, 0.5, 1.0)  # shares of the parameters that a hop moves
SHORT, PROMISING = 12, 1.5  # evaluations, after which a search goes on only if its squares are within this factor
GAIN = 1e-3  # of the squares, that counts as a better end


def with_hops(found: Fit, most_idle: int = IDLE) -> Fit:
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
        if idle == most_idle or best.weighted_rmse < enough:
            break
    return replace(best, hopped=most_idle == IDLE)


def _hopped(best: Fit, rng: np.random.Generator) -> Fit | None:
    free = best.free
    moves = rng.choice(SIZES) * rng.normal(size=len(best.u)) * (rng.random(len(best.u)) < rng.choice(MOVED))
    margin = 1e-6 * np.minimum(free.high - free.low, free.units)
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

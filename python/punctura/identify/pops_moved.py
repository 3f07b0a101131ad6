"""Moves the pops of a fit by a few samples: least squares do not jump over one."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np

from punctura.identify.fit import Fit, fit
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

"""Noise that grows with the force, as where the gain of a sensor is noisy: each sample counts by its own noise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from punctura.identify.fit import DepthError, Fit, Misfit, fit
from punctura.trace import Segments, Trace, TraceError

Array = NDArray[np.float64]

SHARES = np.concatenate(([0.0], np.geomspace(0.1, 30, 26)))  # noise at the greatest force, beside that in air
CLEAR = 20.0  # -2 ln of a likelihood ratio, from which on it grows: chance gives 10 in one of 1000 traces
ALIKE = 1.94  # second differences are correlated by -2/3 and 1/6: so many of them tell as much as one
BESIDE = 3  # samples beside a pop or a turn, where the model may be a sample early or late
OPPOSED = -0.2  # correlation of neighbouring changes: white noise has -0.5, and a wrong model that bends more than 0
FEWEST = 60  # samples that tell


def growth(trace: Trace, segments: Segments, found: Fit) -> float:
    """How much larger the noise is at the greatest force than in air, less by squares; 0 if it does not clearly grow.

    It is that of the second differences of what is left, so a model that is wrong over a way does not count.
    """
    left = trace.force - found.misfit.forces(found.parameters)
    force = _size(found)
    change = (left[2:] - 2 * left[1:-1] + left[:-2]) / np.sqrt(6)
    kept = np.ones(len(trace), bool)
    events = [at for pop in segments.pops for at in (pop.start, pop.end)]
    events += [stroke.start for stroke in segments.strokes]
    for at in events:
        kept[max(0, at - BESIDE) : at + BESIDE + 1] = False
    squares, share = change[kept[1:-1]] ** 2, force[1:-1][kept[1:-1]] / max(float(force.max()), 1e-300)
    if len(squares) < FEWEST or not squares.any():
        return 0.0
    worth = []
    for size in SHARES:
        shape = 1 + (size * share) ** 2
        worth.append(float(np.log(shape).sum() + len(squares) * np.log(np.mean(squares / shape))))
    best = int(np.argmin(worth))
    size = float(SHARES[best])
    scaled = left / np.sqrt(1 + (size * force / max(float(force.max()), 1e-300)) ** 2)
    return size if worth[0] - worth[best] > CLEAR * ALIKE and _is_noise(scaled, kept) else 0.0


def _is_noise(left: Array, kept: NDArray[np.bool_]) -> bool:
    """Whether what is left (n,) changes from sample to sample as noise does, and not as a model that is wrong."""
    changes, inner = np.diff(left), kept[1:-1]
    one, next_one = changes[:-1][inner], changes[1:][inner]
    return bool(one @ next_one < OPPOSED * 0.5 * (one @ one + next_one @ next_one))


def grown(trace: Trace, segments: Segments, found: Fit) -> Array:
    """How many times the noise in air each sample's noise is (n,); 1 where it does not clearly grow."""
    force = _size(found)
    share = growth(trace, segments, found) / max(float(force.max()), 1e-300)
    return np.asarray(np.sqrt(1 + (share * force) ** 2))


def with_growing_noise(trace: Trace, segments: Segments, found: Fit) -> Fit:
    """The fit in which each sample counts by its own noise, if that grows with the force; else the same one."""
    times = grown(trace, segments, found)
    if (times == 1).all():
        return found
    old = found.misfit
    error = DepthError(old.depth_error.mean, old.depth_error.weights / times)
    misfit = Misfit(trace, found.parameters, old.used, old.zero, error, old.whitening)
    try:
        return replace(fit(misfit, found.free.names, found.parameters), others=found.others)
    except TraceError:
        return found


def _size(found: Fit) -> Array:
    return np.asarray(np.abs(found.misfit.forces(found.parameters) - found.parameters.nuisance[0]))

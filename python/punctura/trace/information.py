"""How much a fit is worth: AIC and BIC for dependent residuals, and the samples that it does not see.

punctura.identify.noise.effective_samples() counts the independent samples.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from punctura.trace.segment import Segments

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Information:
    """The information criteria of a fit. Smaller is better, only among fits of the same samples with the same m."""

    samples: int
    parameters: int  # of the model; the noise has one more
    effective_samples: float  # m
    aic: float
    bic: float


def information(residuals: ArrayLike, parameters: int, effective: float) -> Information:
    """AIC and BIC of a least-squares fit with k parameters. residuals (n,): in the order of the samples.

    effective: m, the effective number of samples, the same for all fits that are compared: that of the fit with the
    least error. With s the mean square of the residuals and K = k + 1: AIC = m ln s + 2 K + 2 K (K + 1) / (m - K - 1),
    the corrected form, and BIC = m ln s + K ln m. AIC is infinite for m <= K + 1. Raises ValueError.
    """
    left = _checked(residuals)
    counted = parameters + 1
    level = effective * float(np.log(max(float(np.mean(left**2)), 1e-24)))  # (1e-12 N)^2: the resolution of numbers
    spare = effective - counted - 1
    aic = level + 2 * counted + 2 * counted * (counted + 1) / spare if spare > 0 else float("inf")
    return Information(len(left), parameters, effective, aic, level + counted * float(np.log(max(effective, 1.0))))


def _checked(residuals: ArrayLike) -> Array:
    left = np.asarray(residuals, dtype=np.float64)
    if left.ndim != 1 or len(left) < 3 or not np.isfinite(left).all():
        raise ValueError("residuals must be at least three finite numbers")
    return left


BLOCKS, FOLDS = 20, 4


def held_out(samples: int, segments: Segments) -> list[NDArray[np.bool_]]:
    """Masks (n,) of the samples that each fold leaves out: every fourth of 20 blocks, without the pops.

    A pop and its neighbours are never left out: its place is a parameter of its own, which nothing else in the trace
    tells. The masks depend on the trace alone, so they are the same for all models that are compared.
    """
    block = np.arange(samples) * BLOCKS // samples
    near = max(3, samples // 100)
    free = np.ones(samples, bool)
    for pop in segments.pops:
        free[max(0, pop.start - near) : pop.end + near + 1] = False
    masks = [(block % FOLDS == fold) & free for fold in range(FOLDS)]
    return [mask for mask in masks if mask.any()]

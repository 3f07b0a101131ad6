"""How much a fit is worth: AIC and BIC for residuals that depend on their neighbours.

punctura.identify.noise.effective_samples() counts the independent samples.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

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

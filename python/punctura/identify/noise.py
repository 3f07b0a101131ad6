"""The noise of a fit: how much its residuals are correlated, and how many samples count as independent."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def autocorrelation(residuals: Array, parameters: int = 0) -> Array:
    """Correlation of the residuals at lags 0, 1, 2 ... up to the lag where it is gone; zero is not part of it.

    Uses the initial positive sequence of sums of two neighbouring lags (Geyer 1992), made monotone.
    """
    n = len(residuals)
    most = max(1, min(n // 4, n - 1 - parameters))
    size = 1 << (2 * n - 1).bit_length()
    spectrum = np.abs(np.fft.rfft(residuals, size)) ** 2
    products = np.fft.irfft(spectrum, size)[: most + 1]
    if products[0] <= 0:
        return np.ones(1)
    rho = products / products[0]
    rho = np.concatenate((rho, np.zeros(len(rho) % 2)))
    pairs = rho.reshape(-1, 2).sum(axis=1)
    end = int(np.argmax(pairs <= 0)) if (pairs <= 0).any() else len(pairs)
    return np.asarray(rho[: max(2 * end, 1)])


def effective_samples(residuals: Array, parameters: int = 0) -> float:
    """The number of independent samples that tell as much as these correlated ones; at most n, at least 2."""
    rho = autocorrelation(residuals, parameters)
    inflation = max(1.0, float(1 + 2 * rho[1:].sum()))
    return max(2.0, len(residuals) / inflation)

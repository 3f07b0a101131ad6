"""The noise of a fit as white noise and slow noise together: how likely each mixture is, and what it does to a fit.

The residuals alone show too little of slow noise, because the fit takes it up. So the likelihood is that of what a fit
cannot take up (restricted maximum likelihood, Patterson and Thompson 1971), and all mixtures count by their likelihood.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SHARES = (0.02, 0.06, 0.2, 0.5, 0.8, 0.94, 1.0)  # of the variance, that is slow
LONGEST = 2.0  # lengths of the trace, of the longest correlation
RATIO = 1.8  # from one correlation length to the next


@dataclass(frozen=True)
class Mixture:
    """Noise of variance 1: white, and a share of it with the correlation exp(-lag / length). length: samples."""

    share: float
    length: float

    def solved(self, columns: Array) -> tuple[Array, float]:
        """V^-1 columns and log det V, with the correlation matrix V (n, n) of the noise.

        V = w 1 + a Q^-1 with the tridiagonal inverse Q of an AR(1) noise, so V^-1 = (a 1 + w Q)^-1 Q: O(n).
        """
        from scipy.linalg.lapack import dptsv

        n = len(columns)
        if self.share == 0:
            return columns, 0.0
        rho = float(np.exp(-1 / self.length))
        left = -np.expm1(-2 / self.length)  # 1 - rho^2
        main = np.full(n, (1 + rho**2) / left)
        main[[0, -1]] = 1 / left
        beside = np.full(n - 1, -rho / left)
        right = main[:, None] * columns
        right[:-1] += beside[:, None] * columns[1:]
        right[1:] += beside[:, None] * columns[:-1]
        white = 1 - self.share
        pivots, _, solution, _ = dptsv(self.share + white * main, white * beside, right)
        return np.asarray(solution), float(np.log(pivots).sum() + (n - 1) * np.log(left))

    def smeared(self, columns: Array) -> Array:
        """V columns."""
        from scipy.signal import lfilter

        rho = float(np.exp(-1 / self.length))
        forth = lfilter([1.0], [1.0, -rho], columns, axis=0)
        back = lfilter([1.0], [1.0, -rho], columns[::-1], axis=0)[::-1]
        return np.asarray(self.share * (forth + back - columns) + (1 - self.share) * columns)


def mixtures(samples: int) -> list[Mixture]:
    """White noise, and every mixture that a trace of this length may have."""
    count = int(np.ceil(np.log(LONGEST * samples / 0.6) / np.log(RATIO)))
    lengths = LONGEST * samples / RATIO ** np.arange(count + 1)
    return [Mixture(0.0, 1.0), *(Mixture(share, length) for share in SHARES for length in lengths)]


def spread(residuals: Array, jacobian: Array, inverse: Array) -> Array:
    """The covariance (p, p) of a fit by least squares, averaged over all mixtures by their likelihood.

    inverse: (J^T J)^-1. White noise counts as much as all other mixtures together before the trace is looked at.
    """
    n, p = jacobian.shape
    scale = np.sqrt(np.maximum(np.einsum("ij,ij->j", jacobian, jacobian), 1e-300))
    columns = np.column_stack((jacobian / scale, residuals))
    every = mixtures(n)
    worth, variances = np.empty(len(every)), np.empty(len(every))
    for i, mixture in enumerate(every):
        solved, log_det = mixture.solved(columns)
        gram = columns.T @ solved
        values, vectors = np.linalg.eigh(gram[:p, :p])
        values = np.maximum(values, 1e-12 * values[-1])
        taken = vectors.T @ gram[:p, p]
        left = max(float(gram[p, p] - taken @ (taken / values)), 1e-300)
        variances[i] = left / max(n - p, 1)
        worth[i] = -0.5 * (log_det + np.log(values).sum() + (n - p) * np.log(left))
    worth[1:] -= np.log(len(every) - 1)
    weights = np.exp(worth - worth.max())
    weights /= weights.sum()
    total = np.zeros((p, p))
    for mixture, weight, variance in zip(every, weights, variances, strict=True):
        if weight > 1e-4 * weights.max():
            total += weight * variance * (inverse @ (jacobian.T @ mixture.smeared(jacobian)) @ inverse)
    return total

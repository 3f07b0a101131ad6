"""The noise of a fit as white noise and slow noise together: how likely each mixture is, and what it does to a fit.

The residuals alone show too little of slow noise, because the fit takes it up. So the likelihood is that of what a fit
cannot take up (restricted maximum likelihood, Patterson and Thompson 1971), and all mixtures count by their likelihood.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SHARES = (0.02, 0.06, 0.2, 0.5, 0.8, 0.94, 1.0)  # of the variance, that is slow
LONGEST = 2.0  # lengths of the trace, of the longest correlation
SLOW = 1 / 40  # of the trace, is the least correlation length that counts as slow
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
    p = jacobian.shape[1]
    total = np.zeros((p, p))
    likely = _likely(residuals, jacobian)
    most = max(weight for _, weight, _ in likely)
    for mixture, weight, variance in likely:
        if weight > 1e-4 * most:
            total += weight * variance * (inverse @ (jacobian.T @ mixture.smeared(jacobian)) @ inverse)
    return total


def slow_and_white(residuals: Array, jacobian: Array) -> tuple[float, float]:
    """Standard deviations of the slow and of the other noise, N, in the most likely mixture.

    Slow is a correlation length of at least SLOW of the trace.
    """
    mixture, _, variance = max(_likely(residuals, jacobian), key=lambda one: one[1])
    share = mixture.share if mixture.length >= SLOW * len(residuals) else 0.0
    return float(np.sqrt(share * variance)), float(np.sqrt((1 - share) * variance))


def _likely(residuals: Array, jacobian: Array) -> list[tuple[Mixture, float, float]]:
    """Every mixture with its share of the likelihood and its variance, N^2."""
    n, p = jacobian.shape
    every = mixtures(n)
    worth, variances = np.empty(len(every)), np.empty(len(every))
    for i, (log_det, values, left) in enumerate(_explained(residuals, jacobian, every)):
        variances[i] = left / max(n - p, 1)
        worth[i] = -0.5 * (log_det + np.log(values).sum() + (n - p) * np.log(left))
    worth[1:] -= np.log(len(every) - 1)
    weights = np.exp(worth - worth.max())
    weights /= weights.sum()
    return list(zip(every, weights.tolist(), variances.tolist(), strict=True))


def misfit_beyond_slow_noise(residuals: Array, jacobian: Array) -> float:
    """-2 ln L of a fit, where slow noise of any mixture may explain the residuals, too; smaller is better.

    The mixture is the most likely one, and the parameters follow it by the linear model. Fits of the same samples can
    be compared, also if their parameters differ.
    """
    n = len(residuals)
    explained = _explained(residuals, jacobian, mixtures(n))
    return float(min(log_det + n * np.log(left / n) for log_det, _, left in explained))


def _explained(residuals: Array, jacobian: Array, every: Sequence[Mixture]) -> Iterator[tuple[float, Array, float]]:
    """For each mixture: log det V, the eigenvalues of J^T V^-1 J (scaled), and what V^-1 leaves of the residuals."""
    p = jacobian.shape[1]
    scale = np.sqrt(np.maximum(np.einsum("ij,ij->j", jacobian, jacobian), 1e-300))
    columns = np.column_stack((jacobian / scale, residuals))
    for mixture in every:
        solved, log_det = mixture.solved(columns)
        gram = columns.T @ solved
        values, vectors = np.linalg.eigh(gram[:p, :p])
        values = np.maximum(values, 1e-12 * values[-1])
        taken = vectors.T @ gram[:p, p]
        yield log_det, values, max(float(gram[p, p] - taken @ (taken / values)), 1e-300)

"""The noise of a fit: how much its residuals are correlated, and how likely each mixture of white and slow noise is.

The residuals alone show too little of slow noise, because the fit takes it up. So the likelihood is that of what a fit
cannot take up (restricted maximum likelihood, Patterson and Thompson 1971), and all mixtures count by their likelihood.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

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
    """The number of independent samples that tell as much of a mean as these correlated ones; at least 2, at most n."""
    rho = autocorrelation(residuals, parameters)
    inflation = max(1.0, float(1 + 2 * rho[1:].sum()))
    return max(2.0, len(residuals) / inflation)


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
        from scipy.linalg.lapack import dtbtrs  # scipy.signal takes a second to import

        band = np.ones((2, len(columns)))
        band[1] = -np.exp(-1 / self.length)
        flat = columns.reshape(len(columns), -1)
        forth, back = (dtbtrs(band, one, uplo="L", diag="U")[0] for one in (flat, flat[::-1]))
        forth, back = forth.reshape(columns.shape), back[::-1].reshape(columns.shape)
        return np.asarray(self.share * (forth + back - columns) + (1 - self.share) * columns)


def mixtures(samples: int) -> list[Mixture]:
    """White noise, and every mixture that a trace of this length may have."""
    count = int(np.ceil(np.log(LONGEST * samples / 0.6) / np.log(RATIO)))
    lengths = LONGEST * samples / RATIO ** np.arange(count + 1)
    return [Mixture(0.0, 1.0), *(Mixture(share, length) for share in SHARES for length in lengths)]


@dataclass(frozen=True)
class Likelihood:
    """What one mixture makes of a fit. log_det: of V; log_gram: of J^T V^-1 J, scaled; left: of the squares, N^2."""

    mixture: Mixture
    log_det: float
    log_gram: float
    left: float


class NoiseOfFit:
    """The noise that a fit's residuals (n,), N, show, and its Jacobian (n, p), under every mixture."""

    def __init__(self, residuals: Array, jacobian: Array) -> None:
        self._n, self._p = jacobian.shape
        self._jacobian = jacobian
        self._likelihoods = tuple(_likelihoods(residuals, jacobian, mixtures(self._n)))

    def spread(self, inverse: Array) -> Array:
        """The covariance (p, p) of a fit by least squares, averaged over all mixtures by their likelihood.

        inverse: (J^T J)^-1. White noise counts as much as all other mixtures together before the trace is looked at.
        """
        total = np.zeros((self._p, self._p))
        weights = self._weights()
        for one, weight in zip(self._likelihoods, weights, strict=True):
            if weight > 1e-4 * weights.max():
                smeared = one.mixture.smeared(self._jacobian)
                total += weight * self._variance(one) * (inverse @ (self._jacobian.T @ smeared) @ inverse)
        return total

    def most_likely(self) -> tuple[Mixture, float]:
        """The most likely mixture, and its variance, N^2."""
        best = self._likelihoods[int(np.argmax(self._weights()))]
        return best.mixture, self._variance(best)

    def slow_and_white(self) -> tuple[float, float]:
        """Standard deviations of the slow and of the other noise, N, in the most likely mixture.

        Slow is a correlation length of at least SLOW of the trace.
        """
        best, variance = self.most_likely()
        share = best.share if best.length >= SLOW * self._n else 0.0
        return float(np.sqrt(share * variance)), float(np.sqrt((1 - share) * variance))

    def misfit_beyond_slow_noise(self, allowed: Callable[[Mixture, float], bool]) -> float:
        """-2 ln L of a fit, where slow noise of any allowed mixture may explain the residuals, too; smaller is better.

        allowed: of a mixture and its variance, N^2; white noise always is. The mixture is the most likely one, and the
        parameters follow it by the linear model. Fits of the same samples can be compared, also if their parameters
        differ.
        """
        n = self._n
        worth = [(one.log_det + n * np.log(one.left / n), i, one) for i, one in enumerate(self._likelihoods)]
        return float(
            next(w for w, _, one in sorted(worth) if one.mixture.share == 0 or allowed(one.mixture, one.left / n))
        )

    def _variance(self, one: Likelihood) -> float:
        """Of a sample, N^2."""
        return float(one.left / max(self._n - self._p, 1))

    def _weights(self) -> Array:
        """The likelihood of every mixture, over their sum."""
        n, p = self._n, self._p
        of = self._likelihoods
        worth = np.array([-0.5 * (one.log_det + one.log_gram + (n - p) * np.log(one.left)) for one in of])
        worth[1:] -= np.log(len(worth) - 1)
        weights = np.exp(worth - worth.max())
        return np.asarray(weights / weights.sum())


def _likelihoods(residuals: Array, jacobian: Array, every: Sequence[Mixture]) -> Iterator[Likelihood]:
    """For each mixture: log det V, that of J^T V^-1 J (scaled), and what V^-1 leaves of the residuals."""
    p = jacobian.shape[1]
    scale = np.sqrt(np.maximum(np.einsum("ij,ij->j", jacobian, jacobian), 1e-300))
    columns = np.column_stack((jacobian / scale, residuals))
    for mixture in every:
        solved, log_det = mixture.solved(columns)
        gram = columns.T @ solved
        values, vectors = np.linalg.eigh(gram[:p, :p])
        values = np.maximum(values, 1e-12 * values[-1])
        taken = vectors.T @ gram[:p, p]
        left = max(float(gram[p, p] - taken @ (taken / values)), 1e-300)
        yield Likelihood(mixture, log_det, float(np.log(values).sum()), left)

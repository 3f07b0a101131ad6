"""The covariance of a fit, with correlated noise taken into account."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from punctura.identify.fit import Fit
from punctura.identify.noise import autocorrelation, correlated_gram

Array = NDArray[np.float64]

CHI2_95 = 3.841458820694124  # 95 % of chi-squared with one degree of freedom


class Uncertainty:
    """The covariance of a fit's coordinates, (p, p), for noise whose correlation the residuals show."""

    def __init__(self, fit: Fit) -> None:
        n, p = fit.jacobian.shape
        self.fit = fit
        self.variance = fit.sse / max(n - p, 1)
        gram = fit.jacobian.T @ fit.jacobian
        scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
        values, vectors = np.linalg.eigh(gram / np.outer(scale, scale))
        kept = np.maximum(values, 1e-12 * max(values.max(initial=0), 1e-300))
        inverse = (vectors / kept) @ vectors.T / np.outer(scale, scale)
        rho = autocorrelation(fit.residuals, p)
        correlated = inverse @ correlated_gram(fit.jacobian, rho) @ inverse
        plain = np.maximum(np.diag(inverse), 1e-300)
        self.inflation = np.maximum(np.diag(correlated) / plain, 1.0)  # of each parameter's variance
        grown = np.sqrt(self.inflation)
        self.covariance = self.variance * inverse * np.outer(grown, grown)

    @property
    def correlations(self) -> Array:
        """Correlations of the coordinates, (p, p)."""
        spread = np.sqrt(np.diag(self.covariance))
        return np.asarray(self.covariance / np.outer(spread, spread))

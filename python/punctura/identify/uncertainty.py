"""The covariance of a fit, with correlated noise taken into account."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from punctura.identify.fit import Fit
from punctura.identify.noise import autocorrelation
from punctura.trace.steps import equal_runs, rounding

Array = NDArray[np.float64]

ROUND = 0.75  # of the rms error, from which on it is a rounding


class Uncertainty:
    """The covariance of a fit's coordinates, (p, p), for noise whose correlation the residuals show.

    limit: by how many variances the squares rise to the bound of a 95 % interval. It is the square of Student's t,
    because the variance is estimated, too, from m - p squares. m: so many independent ones tell as much of the variance
    as the n correlated ones, n / (1 + 2 sum rho^2) (Bartlett 1946).
    """

    def __init__(self, fit: Fit) -> None:
        from scipy.special import stdtrit

        n, p = fit.jacobian.shape
        squares = n / (1 + 2 * float((autocorrelation(fit.residuals, p)[1:] ** 2).sum()))
        self.limit = float(stdtrit(max(squares - p, 1.0), 0.975)) ** 2
        self.fit = fit
        self.variance = fit.sse / max(n - p, 1)
        gram = fit.jacobian.T @ fit.jacobian
        steepest = max(float(np.diag(gram).max(initial=0)), 1e-200)
        scale = np.sqrt(np.maximum(np.diag(gram), 1e-24 * steepest))  # some parameters have no effect
        values, vectors = np.linalg.eigh(gram / np.outer(scale, scale))
        kept = np.maximum(values, 1e-12 * max(values.max(initial=0), 1e-300))
        inverse = (vectors / kept) @ vectors.T / np.outer(scale, scale)
        correlated = fit.noise.spread(inverse)
        whitening = fit.misfit.whitening
        by_force = fit.jacobian if whitening is None else whitening.back(fit.jacobian)  # what a sample's error moves
        shared = _between_samples(fit.measured, by_force) + _of_depth(fit, by_force) + _of_steps(fit, by_force)
        correlated += inverse @ shared @ inverse
        plain = np.maximum(self.variance * np.diag(inverse), 1e-300)
        self.covariance = correlated + np.diag(np.maximum(plain - np.diag(correlated), 0.0))
        self.inflation = np.diag(self.covariance) / plain  # of each parameter's variance

    @property
    def correlations(self) -> Array:
        """Correlations of the coordinates, (p, p)."""
        errors = np.sqrt(np.maximum(np.diag(self.covariance), 1e-300))  # 0 for a trace without noise
        return np.asarray(self.covariance / np.outer(errors, errors))


def _of_depth(fit: Fit, by_force: Array) -> Array:
    """What adds to J^T V J (p, p), because neighbours share the error of a depth whose noise is smoothed.

    What it does to a sample alone is part of the noise already, by the weights. by_force (n, p): J, or what stands for
    it where the noise is whitened.
    """
    misfit = fit.misfit
    if misfit.trace.depths is None:
        return np.zeros((by_force.shape[1],) * 2)
    errors = misfit.depth_errors(fit.parameters)
    errors = (misfit.depth_error.weights * (errors - errors.mean(axis=0)))[:, misfit.used]
    shared = by_force.T @ errors.T / np.sqrt(len(errors) - 1)
    own = by_force.T @ (errors.var(axis=0, ddof=1)[:, None] * by_force)
    return np.asarray(shared @ shared.T - own)


def _of_steps(fit: Fit, by_force: Array) -> Array:
    """What adds to J^T V J (p, p), because equal readings of the force in turn have one rounding error.

    Noise that is larger than the steps makes the roundings independent.
    """
    force = fit.misfit.trace.force[fit.misfit.used]
    rounded = rounding(force)
    if rounded < ROUND * fit.weighted_rmse:
        return np.zeros((by_force.shape[1],) * 2)
    shared = np.add.reduceat(by_force, equal_runs(force)[:-1], axis=0)
    return np.asarray(rounded**2 * (shared.T @ shared - by_force.T @ by_force))


def _between_samples(fit: Fit, by_force: Array) -> Array:
    """What adds to J^T V J (p, p), because a sample shows the force at one moment, not where the wall popped before it.

    The place of the pop within the step h is unknown, with a variance of h^2 / 12.
    """
    jacobian, depth = fit.jacobian, fit.misfit.trace.depth[fit.misfit.used]
    added = np.zeros((jacobian.shape[1],) * 2)
    for k, _ in fit.free.walls:
        at = int(np.argmax(depth >= fit.u[k]))  # this coordinate is the depth where the wall pops
        if at == 0:
            continue  # the trace ends in front of the pop
        row = max(at - 1, at, key=lambda one: abs(float(jacobian[one, k])))
        moved = jacobian[row, k] * (depth[at] - depth[at - 1])
        added += np.outer(by_force[row], by_force[row]) * moved**2 / 12
    return added

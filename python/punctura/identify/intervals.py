"""Profile-likelihood intervals of a fit's parameters, with correlated noise taken into account."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from punctura.identify.fit import Fit
from punctura.identify.noise import autocorrelation, correlated_gram
from punctura.identify.parameters import UNITS, kind_of

Array = NDArray[np.float64]

CHI2_95 = 3.841458820694124  # 95 % of chi-squared with one degree of freedom
FARTHEST = 12.0  # standard errors; an interval that goes on beyond is open


@dataclass(frozen=True)
class Estimate:
    """A parameter, SI, and its 95 % interval. low or high is None where the trace sets no bound."""

    name: str
    value: float
    low: float | None
    high: float | None
    unit: str

    @property
    def identifiable(self) -> bool:
        """Whether both bounds are known and, for a positive parameter, at most a factor of 10 apart."""
        if self.low is None or self.high is None:
            return False
        if kind_of(self.name) in ("surface", "growth", "offset", "drift"):
            return True
        return self.high < 10 * max(self.low, 0.02 * self.high)


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


def estimates(fit: Fit) -> tuple[Estimate, ...]:
    """Every free parameter with its interval. That of a surface is of a linear model: the pop is the sharp one."""
    uncertainty = Uncertainty(fit)
    found = []
    values = fit.free.values(fit.u)
    by_u = fit.free.derivatives(fit.u)
    for j, name in enumerate(fit.free.names):
        value = float(values[j])
        if kind_of(name) == "surface":
            row = by_u[fit.free.place(j)]
            spread = float(np.sqrt(max(row @ uncertainty.covariance @ row, 0.0) * CHI2_95))
            low: float | None = value - spread
            high: float | None = value + spread
        else:
            low, high = (_wider(fit, uncertainty, j, side) for side in (-1, 1))
        found.append(Estimate(name, value, low, high, UNITS[kind_of(name)]))
    return tuple(found)


def _wider(fit: Fit, uncertainty: Uncertainty, j: int, side: int) -> float | None:
    """The bound of the profile, or that of a linear model if the profile's is less than half as far.

    A profile rises too early where the search for the other parameters stops on the way, which a rough misfit causes.
    """
    bound = _bound(fit, uncertainty, j, side)
    if bound is None:
        return None
    u = float(np.log(bound)) if fit.free.logarithmic(j) else bound
    far = float(np.sqrt(CHI2_95 * uncertainty.covariance[j, j]))
    if abs(u - fit.u[j]) >= 0.5 * far:
        return bound
    u = fit.u[j] + side * far
    if not fit.free.low[j] < u < fit.free.high[j]:
        return None
    return float(np.exp(u)) if fit.free.logarithmic(j) else float(u)


def _bound(fit: Fit, uncertainty: Uncertainty, j: int, side: int) -> float | None:
    """Where the profile of parameter j rises by chi-squared; None if it does not within its range."""
    free, start = fit.free, fit.u
    limit = CHI2_95 * uncertainty.variance * uncertainty.inflation[j]
    error = float(np.sqrt(uncertainty.covariance[j, j]))
    room = (free.high[j] - start[j]) if side > 0 else (start[j] - free.low[j])
    follow = uncertainty.covariance[:, j] / uncertainty.covariance[j, j]  # how the others move along
    step, below, above = min(1.96 * error, room), (0.0, 0.0), None
    if not error > 0 or not np.isfinite(error):
        return None
    at = start
    for _ in range(6):
        guess = np.clip(at + follow * (start[j] + side * step - at[j]), free.low, free.high)
        at, rise = _constrained(fit, guess, j, start[j] + side * step)
        height = float(np.sqrt(max(rise, 0.0) / limit))
        if abs(height - 1) < 0.03:
            below = (step, 1.0)
            break
        if height > 1:
            above = (step, height)
        else:
            below = (step, height)
            if step >= room or step > FARTHEST * max(error, 1e-3):
                return None
        if above is None:
            step = min(step * min(max(1.05 / max(height, 0.2), 1.3), 3.0), room)
        else:
            step = below[0] + (above[0] - below[0]) * (1 - below[1]) / (above[1] - below[1])
    u = start.copy()
    u[j] = start[j] + side * (below[0] if above is None or below[1] == 1.0 else step)
    return float(np.exp(u[j]) if free.logarithmic(j) else u[j])


def _constrained(fit: Fit, guess: Array, j: int, fixed: float) -> tuple[Array, float]:
    """The least squares of the other parameters with parameter j fixed, by Gauss-Newton steps; and the rise of SSE."""
    others = np.arange(len(guess)) != j
    at = guess.copy()
    at[j] = fixed
    left = fit.misfit.residuals(fit.free, at)
    best = float(left @ left)
    for _ in range(3):
        jacobian = fit.misfit.jacobian(fit.free, at)[:, others]
        scale = np.sqrt(np.maximum(np.einsum("ij,ij->j", jacobian, jacobian), 1e-300))
        gram = (jacobian / scale).T @ (jacobian / scale)
        move = np.linalg.solve(gram + 1e-9 * np.eye(len(gram)), -(jacobian / scale).T @ left) / scale
        trial = at.copy()
        for share in (1.0, 0.3, 0.1):
            trial[others] = np.clip(at[others] + share * move, fit.free.low[others], fit.free.high[others])
            moved = fit.misfit.residuals(fit.free, trial)
            if moved @ moved < best:
                break
        gained = best - float(moved @ moved)
        if gained <= 0:
            break
        at, left, best = trial.copy(), moved, float(moved @ moved)
        if gained < 1e-3 * fit.sse / len(left):
            break
    return at, best - fit.sse

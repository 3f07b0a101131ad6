"""The profile likelihood of one parameter: where the sum of squares rises, while all others follow."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from punctura.identify.fit import Fit
from punctura.identify.parameters import Parameters
from punctura.identify.uncertainty import Uncertainty

BETTER = 1.0  # variances of a sample, by which the squares must be less: below that it is the same optimum


class BetterPoint(Exception):
    """Parameters that explain the trace better than the fit, whose optimum is therefore not the best one."""

    def __init__(self, parameters: Parameters) -> None:
        super().__init__("parameters beside the fit explain the trace better than the fit")
        self.parameters = parameters


@dataclass(frozen=True, eq=False)
class Watch:
    """Compares every point of a search with the fit. stops: a better point ends the search with BetterPoint.

    An interval about a lesser optimum says nothing, so the search need not go on.
    """

    fit: Fit
    stops: bool = True

    def met(self, sse: float, parameters: Callable[[], Parameters]) -> None:
        """A point with this sum of squares, N^2. Raises BetterPoint."""
        n, p = self.fit.jacobian.shape
        if self.stops and sse < self.fit.sse * (1 - BETTER / max(n - p, 1)):
            raise BetterPoint(parameters())


Array = NDArray[np.float64]

FARTHEST = 12.0  # standard errors; an interval that goes on beyond is open


def bound(uncertainty: Uncertainty, j: int, side: int, used: float = 0.0, watch: Watch | None = None) -> float | None:
    """The bound of parameter j below (side -1) or above (+1), SI; None if there is none. Raises BetterPoint.

    watch: looks at the points on the way. used: how far the optimum is above the best one, N^2. The bound is that of
    the profile, or that of a linear model if the profile's is less than half as far: a profile rises too early where
    the search for the other parameters stops on the way, which a rough misfit causes.
    """
    fit = uncertainty.fit
    found = _bound(uncertainty, j, side, used, watch)
    if found is None:
        return None
    u = float(np.log(found)) if fit.free.logarithmic(j) else found
    far = float(np.sqrt(uncertainty.limit * uncertainty.covariance[j, j]))
    if abs(u - fit.u[j]) >= 0.5 * far:
        return found
    u = fit.u[j] + side * far
    if not fit.free.low[j] < u < fit.free.high[j]:
        return None
    return float(np.exp(u)) if fit.free.logarithmic(j) else float(u)


def _bound(uncertainty: Uncertainty, j: int, side: int, used: float, watch: Watch | None) -> float | None:
    """Where the profile of parameter j rises by the limit; None if it does not within its range."""
    fit = uncertainty.fit
    free, start = fit.free, fit.u
    limit = max(uncertainty.limit * uncertainty.variance * uncertainty.inflation[j] - used, 0.1 * uncertainty.variance)
    error = float(np.sqrt(uncertainty.covariance[j, j]))
    room = (free.high[j] - start[j]) if side > 0 else (start[j] - free.low[j])
    step, below, above = min(1.96 * error, room), (0.0, 0.0), None
    if not error > 0 or not np.isfinite(error):
        return None
    follow = uncertainty.covariance[:, j] / uncertainty.covariance[j, j]  # how the others move along
    at = start
    for _ in range(6):
        guess = np.clip(at + follow * (start[j] + side * step - at[j]), free.low, free.high)
        at, rise = _constrained(fit, guess, j, start[j] + side * step)
        if watch is not None:
            watch.met(fit.sse + rise, partial(free.parameters, at))
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
        if not np.isfinite(jacobian).all():  # far from the fit, a steep grip overflows
            break
        squares = np.einsum("ij,ij->j", jacobian, jacobian)
        scale = np.sqrt(np.maximum(squares, max(1e-24 * squares.max(initial=0), 1e-200)))  # some have no effect here
        gram = (jacobian / scale).T @ (jacobian / scale)
        move = np.linalg.solve(gram + 1e-9 * np.eye(len(gram)), -(jacobian / scale).T @ left) / scale
        trial = at.copy()
        for share in (1.0, 0.3, 0.1):
            trial[others] = np.clip(at[others] + share * move, fit.free.low[others], fit.free.high[others])
            moved = fit.misfit.residuals(fit.free, trial)
            if moved @ moved < best:
                break
        gained = best - float(moved @ moved)
        if not gained > 0:
            break
        at, left, best = trial.copy(), moved, float(moved @ moved)
        if gained < 1e-3 * fit.sse / len(left):
            break
    return at, best - fit.sse

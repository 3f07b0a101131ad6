"""Fits free parameters to a trace: nonlinear least squares on the core, with exact derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from punctura._core import TraceModel
from punctura.identify.parameters import Free, Parameters
from punctura.trace import Trace, TraceError

Array = NDArray[np.float64]


class Misfit:
    """Measured minus model force along a trace, and its derivatives. One object serves any number of fits."""

    def __init__(self, trace: Trace, parameters: Parameters, used: NDArray[np.bool_] | None = None) -> None:
        """used: (n,), the samples that count; all samples move the needle."""
        self.trace = trace
        self.used = np.ones(len(trace), bool) if used is None else used
        self._model = TraceModel(parameters.needle, trace.depth, trace.time)
        self._nuisance = np.column_stack((np.ones(len(trace)), np.zeros(len(trace))))
        if trace.time is not None:
            self._nuisance[:, 1] = trace.time - trace.time[0]

    def forces(self, parameters: Parameters) -> Array:
        """The model's force at every sample (n,), N, with offset and drift of the sensor."""
        force, _ = self._model.forces(parameters.membranes, parameters.coupling, False)
        return np.asarray(force + self._nuisance @ parameters.nuisance)

    def residuals(self, free: Free, u: Array) -> Array:
        """Model minus measured force at the used samples, N."""
        return (self.forces(free.parameters(u)) - self.trace.force)[self.used]

    def jacobian(self, free: Free, u: Array) -> Array:
        """Derivatives of the residuals by the coordinates."""
        parameters = free.parameters(u)
        _, by_all = self._model.forces(parameters.membranes, parameters.coupling, True)
        return free.chain(np.hstack((by_all, self._nuisance))[self.used], u)


@dataclass(frozen=True, eq=False)
class Fit:
    """The result of a fit. u: coordinates; jacobian: (used samples, free), by the coordinates."""

    misfit: Misfit
    free: Free
    u: Array
    residuals: Array
    jacobian: Array
    evaluations: int

    @property
    def parameters(self) -> Parameters:
        """All parameters of the fit."""
        return self.free.parameters(self.u)

    @property
    def sse(self) -> float:
        """Sum of squared residuals, N^2."""
        return float(self.residuals @ self.residuals)

    @property
    def rmse(self) -> float:
        """Root mean square of the residuals, N."""
        return float(np.sqrt(self.sse / len(self.residuals)))


def fit(misfit: Misfit, names: Sequence[str], start: Parameters, evaluations: int = 400) -> Fit:
    """The parameters `names` that fit best, from `start`. Raises TraceError if the search does not end."""
    from scipy.optimize import least_squares

    free = Free(names, start)
    u = free.coordinates(start)
    if len(u) == 0:
        left = misfit.residuals(free, u)
        return Fit(misfit, free, u, left, misfit.jacobian(free, u), 1)
    known: dict[bytes, tuple[Array, Array]] = {}  # the search asks for residuals and derivatives at the same place

    def both(at: Array) -> tuple[Array, Array]:
        key = at.tobytes()
        if key not in known:
            known.clear()
            known[key] = misfit.residuals(free, at), misfit.jacobian(free, at)
        return known[key]

    span = free.high - free.low
    inside = np.clip(u, free.low + 1e-9 * np.minimum(span, 1), free.high - 1e-9 * np.minimum(span, 1))
    found = least_squares(
        lambda at: misfit.residuals(free, at), inside, lambda at: both(at)[1], (free.low, free.high),
        method="trf", x_scale="jac", ftol=1e-10, xtol=1e-10, gtol=1e-12, max_nfev=evaluations,
    )  # fmt: skip
    if not found.success:
        raise TraceError(f"the fit did not end after {evaluations} evaluations: {found.message}")
    return Fit(misfit, free, found.x, found.fun, np.asarray(found.jac), int(found.nfev))

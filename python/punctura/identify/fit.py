"""Fits free parameters to a trace: nonlinear least squares on the core, with exact derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from punctura.errors import ConfigurationError
from punctura.identify.least_squares import least_squares
from punctura.identify.noise import Mixture, NoiseOfFit
from punctura.identify.parameters import ZERO, Free, Parameters
from punctura.identify.sensor import SensedModel
from punctura.identify.whitening import Whitening
from punctura.trace import Trace, TraceError
from punctura.trace.air import spread
from punctura.trace.friction import friction_of_slide
from punctura.trace.rig_force import KEPT, RIG_FORCES, shapes

Array = NDArray[np.float64]

NEARLY = 30.0  # variances of a sample by which another search may be worse and still count
FURTHER, LITTLE = 30, 0.1  # evaluations of a round after the last one, and what it must gain
NEAR = 2  # samples on both sides, for a speed
_KEPT = [ZERO.index(RIG_FORCES[i]) for i in KEPT]
ROUNDS = 20  # of them, at most
HOPELESS = 2.0  # times the squares of the best search so far: one that creeps above them goes on no longer


class Misfit:
    """Measured minus model force along a trace, and its derivatives. One object serves any number of fits."""

    def __init__(
        self,
        trace: Trace,
        parameters: Parameters,
        used: NDArray[np.bool_] | None = None,
        zero: tuple[float, float] = (-np.inf, np.inf),
        depth_error: DepthError | None = None,
        whitening: Whitening | None = None,
    ) -> None:
        """used: (n,), the samples that count; all samples move the needle. zero: what the air tells of it, N.

        depth_error: what the noise of the depth does to the force. whitening: of correlated noise of the force.
        """
        self.trace = trace
        self.zero = zero
        self.evaluations = 0  # of the derivatives, by all fits so far
        self.depth_error = depth_error or DepthError(np.zeros(len(trace)), np.ones(len(trace)))
        self.used = np.ones(len(trace), bool) if used is None else used
        self.whitening = whitening
        self._plain = bool(self.used.all() and (self.depth_error.weights == 1).all())
        self._model = SensedModel(parameters.needle, trace.depth, trace.time)
        since = np.zeros(len(trace)) if trace.time is None else trace.time - trace.time[0]
        self._nuisance = np.column_stack((np.ones(len(trace)), since, shapes(trace)))
        self._subtracted = np.array(trace.rig_sizes)[list(KEPT)]
        if trace.slide is not None:
            self._nuisance[:, _KEPT] = 0.0
            self._rubbed = friction_of_slide(trace.slide, *self._subtracted)[0]

    def free(self, names: Sequence[str], base: Parameters) -> Free:
        """These parameters as the free ones of a fit to this trace; all others are as in `base`."""
        return Free(names, base, float(self.trace.depth.max()), self.zero, self._speed_at, self.trace.scale)

    def _speed_at(self, depth: float) -> float:
        """How fast the needle first comes to a depth, m/s; 0 without time, or if it does not."""
        trace = self.trace
        at = int(np.argmax(trace.depth >= depth))
        if trace.time is None or at == 0:
            return 0.0
        near = slice(max(at - NEAR, 0), at + NEAR)
        return float(np.ptp(trace.depth[near]) / np.ptp(trace.time[near]))

    def forces(self, parameters: Parameters) -> Array:
        """The model's force at every sample (n,), N, with that of the rig."""
        return np.asarray(self._model.forces(parameters) + self.depth_error.mean + self.of_rig(parameters))

    def of_rig(self, parameters: Parameters) -> Array:
        """What sensor and rig add at every sample (n,), N: offset, drift, friction of the slide, pull of a cable."""
        linear = np.asarray(self._nuisance @ parameters.nuisance[: len(ZERO)])
        return linear if self.trace.slide is None else linear + self._friction(parameters)[0] - self._rubbed

    def _friction(self, parameters: Parameters) -> tuple[Array, Array]:
        """Friction of the slide that a rest keeps, with what is subtracted of it, and its derivatives."""
        assert self.trace.slide is not None
        return friction_of_slide(self.trace.slide, *(self._subtracted + parameters.nuisance[_KEPT]))

    def residuals(self, free: Free, u: Array, blur: int = 0) -> Array:
        """Model minus measured force at the used samples, N; infinite for no law. blur: see blurred()."""
        try:
            left = self.forces(free.parameters(u)) - self.trace.force
        except ConfigurationError:  # a steep grip overflows where its wall pops
            return np.full(int(self.used.sum()), np.inf)
        return np.asarray(self._weighted(blurred(left[:, None], blur))[:, 0])

    def jacobian(self, free: Free, u: Array, blur: int = 0) -> Array:
        """Derivatives of the residuals by the coordinates."""
        self.evaluations += 1
        parameters, by_rig = free.parameters(u), self._nuisance
        by_model, by_late = self._model.jacobian(parameters, free.kinds, free.late)
        if self.trace.slide is not None:
            by_rig = by_rig.copy()
            by_rig[:, _KEPT] = self._friction(parameters)[1]
        by_all = np.hstack((by_model, by_rig, by_late))
        return self._weighted(blurred(by_all @ free.derivatives(u), blur))

    def _weighted(self, columns: Array) -> Array:
        kept = columns if self._plain else np.asarray((self.depth_error.weights[:, None] * columns)[self.used])
        return kept if self.whitening is None else self.whitening(kept)

    def whitened(self, parameters: Parameters, noise: Mixture | None) -> Misfit:
        """The same misfit, in which noise of this mixture is white; None: as it is measured."""
        whitening = None if noise is None else Whitening(noise, int(self.used.sum()))
        return Misfit(self.trace, parameters, self.used, self.zero, self.depth_error, whitening)

    def with_depth_error(self, parameters: Parameters) -> Misfit:
        """The same misfit, with what the noise of the depth does to the force near these parameters."""
        if self.trace.depths is None:
            return self
        errors = self.depth_errors(parameters)
        left = self.forces(parameters) - self.trace.force
        noise = spread(left[self.used])
        weights = noise / np.sqrt(noise**2 + errors.var(axis=0, ddof=1)) if noise > 0 else np.ones(len(left))
        return Misfit(self.trace, parameters, self.used, self.zero, DepthError(errors.mean(axis=0), weights))

    def depth_errors(self, parameters: Parameters) -> Array:
        """Draws (m, n) of the force, N, that the most likely depth leaves out: that of the true depth, less its own."""
        depths = self.trace.depth[None, :] if self.trace.depths is None else self.trace.depths
        models = (SensedModel(parameters.needle, depth, self.trace.time) for depth in depths)
        return np.array([model.forces(parameters) for model in models]) - self._model.forces(parameters)


@dataclass(frozen=True, eq=False)
class DepthError:
    """What the noise of the depth does to the force of each sample (n,). mean: N; weights: of a residual, at most 1."""

    mean: Array
    weights: Array


def blurred(columns: Array, width: int) -> Array:
    """Moving averages of columns over `width` samples, twice. 0: unchanged.

    A pop of the model that is a few samples away from the measured one finds its way there in blurred residuals.
    """
    for _ in range(2 if width > 1 else 0):
        half = width // 2
        padded = np.vstack((np.repeat(columns[:1], half, 0), columns, np.repeat(columns[-1:], half, 0)))
        total = np.vstack((np.zeros((1, columns.shape[1])), np.cumsum(padded, axis=0)))
        columns = (total[2 * half + 1 :] - total[: -2 * half - 1]) / (2 * half + 1)
    return columns


@dataclass(frozen=True, eq=False)
class Fit:
    """The result of a fit. u: coordinates; jacobian: (used samples, free), by the coordinates.

    others: ends of other searches that are nearly as good, as parameters. hopped: hops from here find no better end.
    """

    misfit: Misfit
    free: Free
    u: Array
    residuals: Array
    jacobian: Array
    evaluations: int
    others: tuple[Parameters, ...] = ()
    hopped: bool = False

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
        """Root mean square of model less measured force at the used samples, N; each of them counts the same."""
        left = self.misfit.forces(self.parameters) - self.misfit.trace.force
        return float(np.sqrt(np.mean(left[self.misfit.used] ** 2)))

    @property
    def weighted_rmse(self) -> float:
        """Root mean square of the residuals, N, weighted for the noise of the depth, and whitened: for rules."""
        return float(np.sqrt(self.sse / len(self.residuals)))

    @property
    def measured(self) -> Fit:
        """The same parameters, with the residuals as they are measured: not whitened."""
        if self.misfit.whitening is None:
            return self
        misfit = self.misfit.whitened(self.parameters, None)
        residuals, jacobian = misfit.residuals(self.free, self.u), misfit.jacobian(self.free, self.u)
        return replace(self, misfit=misfit, residuals=residuals, jacobian=jacobian)

    @cached_property
    def noise(self) -> NoiseOfFit:
        """The noise that the residuals show. It is computed once: that takes longer than an evaluation of the model."""
        return NoiseOfFit(self.residuals, self.jacobian)


def squares_beyond(misfit: Misfit, free: Free, u: Array) -> float:
    """The squares, N^2, that the model leaves if it is linear about u (p,)."""
    residuals, columns = misfit.residuals(free, u), misfit.jacobian(free, u)
    known = columns / np.maximum(np.sqrt(np.sum(columns**2, axis=0)), 1e-300)
    left = residuals - known @ np.linalg.lstsq(known, residuals, rcond=1e-10)[0]
    return float(left @ left)


def in_order(found: Fit) -> Fit:
    """The same fit, and its other ends, with the walls in the order of their depth: a search may swap them."""
    others = tuple(other.in_order() for other in found.others)
    parameters, free = found.parameters, found.free
    ordered = parameters.in_order()
    if np.array_equal(ordered.membranes, parameters.membranes):
        return replace(found, others=others)
    misfit = found.misfit
    free = misfit.free(free.names, ordered)
    u = free.coordinates(ordered)
    residuals, jacobian = misfit.residuals(free, u), misfit.jacobian(free, u)
    return Fit(misfit, free, u, residuals, jacobian, found.evaluations, others)


def fit(
    misfit: Misfit,
    names: Sequence[str],
    start: Parameters,
    blurs: Sequence[int] = (0,),
    evaluations: int = 200,
    hopeless: float = np.inf,
) -> Fit:
    """The parameters `names` that fit best, from `start`. blurs: widths in samples, one search after the other.

    If the pop of a wall enters or leaves the trace on the way, one more search has its other coordinate (see Free).

    A search that creeps along a valley counts as ended: more steps gain less than a tenth of the variance of a sample.
    Raises TraceError if the last search does not end, creeps where the squares are above `hopeless`, N^2, or ends where
    the derivatives overflow, as those of a steep grip do.
    """
    free = misfit.free(names, start)
    u = free.coordinates(start)
    count = 0
    for blur in blurs:
        u, more, message = _search(misfit, free, u, blur, evaluations)
        count += more
    other = misfit.free(names, free.parameters(u))
    if other.walls != free.walls:
        u, free = other.coordinates(free.parameters(u)), other
        u, more, message = _search(misfit, free, u, 0, evaluations)
        count += more
    rounds = ROUNDS if message and blurs[-1] == 0 else 0
    cost = _cost(misfit, free, u)
    for i in range(rounds):
        before = cost
        if cost > hopeless:
            raise TraceError(f"the fit creeps after {count} evaluations, far from the best one")
        u, more, message = _search(misfit, free, u, 0, FURTHER)
        count, cost = count + more, _cost(misfit, free, u)
        if not message or before - cost <= LITTLE * before / len(misfit.trace):
            break
        if i == rounds - 1:
            raise TraceError(f"the fit did not end after {count} evaluations: {message}")
    found = Fit(misfit, free, u, misfit.residuals(free, u), misfit.jacobian(free, u), count)
    if not np.isfinite(found.jacobian).all():
        raise TraceError(f"the derivatives of the model overflow where the fit ended, after {count} evaluations")
    return found


def shortly(misfit: Misfit, free: Free, u: Array, evaluations: int, limit: float) -> Fit | None:
    """The fit from the coordinates u; None if its sum of squares is above `limit`, N^2, after some evaluations.

    Raises TraceError, as fit() does.
    """
    u, _, message = _search(misfit, free, u, 0, evaluations)
    if message and _cost(misfit, free, u) > limit:
        return None
    return fit(misfit, free.names, free.parameters(u))


def _cost(misfit: Misfit, free: Free, u: Array) -> float:
    left = misfit.residuals(free, u)
    return float(left @ left)


@dataclass(frozen=True)
class Start:
    """Where a search begins. blurred: a second search begins with blurred residuals, for pops at the wrong samples."""

    parameters: Parameters
    blurred: bool = False


def best_fit(misfit: Misfit, names: Sequence[str], starts: Sequence[Start], enough: float = 0.0) -> Fit:
    """The best of several fits. One with an rms error below `enough`, N, ends the search. Raises TraceError."""
    n = int(misfit.used.sum())
    wide = (max(n // 20, 5), max(n // 80, 3), 0)
    ends: list[Fit] = []
    reason = "there is no start"
    for start in starts:
        for blurs in ((0,), wide) if start.blurred else ((0,),):
            try:
                limit = HOPELESS * min((end.sse for end in ends), default=np.inf)
                found = fit(misfit, names, start.parameters, blurs, hopeless=limit)
            except TraceError as error:
                reason = str(error)
                continue
            if found.weighted_rmse < enough:
                return found
            ends.append(found)
    if not ends:
        raise TraceError(reason)
    return best_of(ends)


def best_of(ends: Sequence[Fit]) -> Fit:
    """The fit with the least sum of squares. Its `others` are the ends that are nearly as good, and those of all."""
    best = min(ends, key=lambda end: end.sse)
    limit = best.sse * (1 + NEARLY / len(best.residuals))
    near = tuple(end.parameters for end in ends if end is not best and end.sse < limit)
    return replace(best, others=(*(other for end in ends for other in end.others), *near))


def _search(misfit: Misfit, free: Free, u: Array, blur: int, evaluations: int) -> tuple[Array, int, str]:
    """The coordinates of the least squares, the number of evaluations, and a message if the search did not end."""
    if len(u) == 0:
        return u, 0, ""
    margin = 1e-9 * np.minimum(free.high - free.low, free.units)
    most = 15 if blur else evaluations
    units = free.units
    found, count, ended = least_squares(
        lambda at: misfit.residuals(free, at * units, blur), lambda at: misfit.jacobian(free, at * units, blur) * units,
        u / units, ((free.low + margin) / units, (free.high - margin) / units),
        1e-3 if blur else 1e-7, 1e-7, most,
    )  # fmt: skip
    return found * units, count, "" if ended else f"no end within {most} evaluations"

"""Profile-likelihood intervals of a fit's parameters, with correlated noise taken into account."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from punctura.identify.fit import Fit
from punctura.identify.fit import fit as fitted
from punctura.identify.parameters import NUISANCE, UNITS, Parameters, kind_of
from punctura.identify.profile import Watch, bound
from punctura.identify.start import other_grips
from punctura.identify.uncertainty import Uncertainty
from punctura.trace import Trace, TraceError
from punctura.trace.rig_force import RIG_FORCES, SLIDE_WAY

Array = NDArray[np.float64]

SEARCHES, OUTWARDS = 8, 1.5  # of a bound that moves outwards: how often, and by which factor
NEAR = 2.0  # times the rise that a bound may have: a search that creeps above it goes on no longer


@dataclass(frozen=True)
class Estimate:
    """A parameter, SI, and its 95 % interval. low or high is None where the trace sets no bound."""

    name: str  # such as membrane[0].stiffness
    value: float  # the best fit
    low: float | None
    high: float | None
    unit: str  # SI
    widest: float = np.inf  # an interval that is wider tells nothing of it: for an offset, the range of the force

    @property
    def identifiable(self) -> bool:
        """Whether both bounds are known, the interval is not too wide to tell anything, and the bounds of a positive
        parameter are at most a factor of 10 apart.
        """
        if self.low is None or self.high is None or self.high - self.low > self.widest:
            return False
        if kind_of(self.name) in ("surface", "growth", *NUISANCE):
            return True
        return self.high < 10 * max(self.low, 0.02 * self.high)


def estimates(
    fit: Fit, others: Sequence[Parameters] = (), stops: bool = True, outwards: bool = True
) -> tuple[Estimate, ...]:
    """Every free parameter with its interval. That of a surface is of a linear model: the pop is the sharp one. A
    surface that can be farther away than the trace is long has no bounds.

    others: ends of other searches. One that explains the trace nearly as well as the fit has an interval of its own,
    and each estimate's interval reaches over all of them. stops: raises BetterPoint where a search meets one.
    outwards: full searches move the bounds outwards, which takes most of the time.
    """
    watch = Watch(fit, stops)
    main = Uncertainty(fit)
    modes = [main, *_modes(main, others, watch)]
    found = []
    values = fit.free.values(fit.u)
    for j, name in enumerate(fit.free.names):
        bounds = [_bounds(mode, j, mode.fit.sse - fit.sse, watch) for mode in modes]
        lows, highs = [low for low, _ in bounds], [high for _, high in bounds]
        low = None if None in lows else min(low for low in lows if low is not None)
        high = None if None in highs else max(high for high in highs if high is not None)
        found.append(Estimate(name, float(values[j]), low, high, UNITS[kind_of(name)], _widest(fit, name)))
    if not outwards or all(estimate.identifiable for estimate in found):
        return tuple(found)
    return tuple(_searched_again(main, j, estimate, others, watch) for j, estimate in enumerate(found))


def with_subtracted(found: Sequence[Estimate], trace: Trace) -> tuple[Estimate, ...]:
    """The estimates; that of a force of the rig is the sum of what is subtracted and what the fit adds."""
    sizes = dict(zip(RIG_FORCES, trace.rig_sizes, strict=True))
    return tuple(
        replace(
            one,
            value=one.value + size,
            low=None if one.low is None else one.low + size,
            high=None if one.high is None else one.high + size,
        )
        for one in found
        for size in [sizes.get(one.name, 0.0)]
    )


def _widest(fit: Fit, name: str) -> float:
    """The width of an interval that tells nothing of a zero of the sensor, SI."""
    trace = fit.misfit.trace
    if name == "offset" or name.startswith("slide_friction"):
        return float(np.ptp(trace.force))
    if name == "drift" and trace.time is not None:
        return float(np.ptp(trace.force) / np.ptp(trace.time))
    if name == "cable_stiffness":
        return float(np.ptp(trace.force) / np.ptp(trace.depth))
    return np.inf


def _searched_again(
    main: Uncertainty, j: int, estimate: Estimate, others: Sequence[Parameters], watch: Watch
) -> Estimate:
    """The estimate with bounds moved outwards as long as a full search for the other parameters fits there as well.

    Where some parameters cannot be told, the others follow a long, curved valley, which few steps do not follow.
    """
    if not estimate.identifiable or kind_of(estimate.name) in ("surface", *NUISANCE):
        return estimate
    low, high = (_outwards(main, j, edge, others, watch) for edge in (estimate.low, estimate.high))
    return replace(estimate, low=low, high=high)


def _outwards(
    main: Uncertainty, j: int, value: float | None, others: Sequence[Parameters], watch: Watch
) -> float | None:
    fit, free = main.fit, main.fit.free
    if value is None:
        return None
    limit = 0.8 * main.limit * main.variance * main.inflation[j]
    names = [name for name in free.names if name != free.names[j]]
    at = float(np.log(value)) if free.logarithmic(j) else value
    last = fit.parameters
    # Other grips explain a rise that the trace leaves unfinished; of several walls that pop, they are no use.
    several = len(fit.parameters.membranes) > 1 and len(free.walls) == len(fit.parameters.membranes)
    for _ in range(SEARCHES):
        value = float(np.exp(at) if free.logarithmic(j) else at)
        for start in (last, *others, *(() if several else other_grips(last))):
            try:
                there = start.with_values({free.names[j]: value})
                end = fitted(fit.misfit, names, there, evaluations=60, hopeless=fit.sse + NEAR * limit)
            except TraceError:
                continue
            watch.met(end.sse, partial(_parameters, end))
            if end.sse - fit.sse <= limit:
                break
        else:
            return value
        last = end.parameters
        at = fit.u[j] + OUTWARDS * (at - fit.u[j])
        if not free.low[j] < at < free.high[j]:
            return None
    return None


def _parameters(end: Fit) -> Parameters:
    return end.parameters


def _modes(main: Uncertainty, others: Sequence[Parameters], watch: Watch) -> Iterator[Uncertainty]:
    """Other optima within the confidence region: far from the fit, and with nearly its sum of squares."""
    seen = [main.fit.u]
    errors = np.sqrt(np.diag(main.covariance))
    limit = main.limit * main.variance * float(main.inflation.max())
    for other in others:
        try:
            found = fitted(main.fit.misfit, main.fit.free.names, other)
        except TraceError:
            continue
        watch.met(found.sse, partial(_parameters, found))
        if found.sse - main.fit.sse < limit and all(np.any(np.abs(found.u - u) > errors) for u in seen):
            seen.append(found.u)
            yield Uncertainty(found)


def _bounds(uncertainty: Uncertainty, j: int, used: float, watch: Watch) -> tuple[float | None, float | None]:
    """The interval of parameter j at one optimum, whose sum of squares is `used` (N^2) above that of the best one."""
    fit = uncertainty.fit
    if kind_of(fit.free.names[j]) == "surface":
        row = fit.free.derivatives(fit.u)[fit.free.place(j)]
        spread = float(np.sqrt(max(row @ uncertainty.covariance @ row, 0.0) * uncertainty.limit))
        value = float(fit.free.values(fit.u)[j])
        if spread > float(np.ptp(fit.misfit.trace.depth)):
            return None, None
        return value - spread, value + spread
    found = bound(uncertainty, j, -1, used, watch), bound(uncertainty, j, 1, used, watch)
    if fit.free.names[j] == "slide_way":
        none = -fit.misfit.trace.rig_sizes[SLIDE_WAY]  # it is positive, also where the fit does not say so
        return (none if found[0] is None else max(found[0], none)), found[1]
    if kind_of(fit.free.names[j]) != "offset":
        return found
    air = float(fit.free.low[j]), float(fit.free.high[j])  # it bounds the offset where the fit does not
    low, high = (edge if one is None and np.isfinite(edge) else one for one, edge in zip(found, air, strict=True))
    return low, high

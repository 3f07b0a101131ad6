"""Fits a rival to a trace: bounded least squares from several starts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from punctura.extras import optional
from punctura.rivals.kinds import RivalKind
from punctura.rivals.layers import Layer, Path, path_of
from punctura.rivals.problem import Problem
from punctura.rivals.starts import Wall, walls_of
from punctura.trace import Segments, Trace, segment
from punctura.trace.information import held_out

Array = NDArray[np.float64]
STARTS = 6
SEARCHED = 600  # samples while the fit searches; the last step uses all


@dataclass(frozen=True)
class RivalFit:
    """A rival fitted to a trace. SI."""

    kind: RivalKind  # of rival
    layers: tuple[Layer, ...]  # by depth
    parameters: int  # fitted, with the punctures
    force: Array = field(repr=False)  # (n,), N, against the insertion
    residuals: Array = field(repr=False)  # (n,), N, measured less computed
    converged: bool  # the solver ended at an optimum
    agreeing: int  # of the starts, how many ended within 1 % of the least error
    starts: int  # fits that were begun
    held_out_rmse: float  # N, of samples that the fit did not see
    surface: float  # m, of the first layer

    @property
    def name(self) -> str:
        """Of the kind, for programs."""
        return self.kind.name

    @property
    def title(self) -> str:
        """Of the kind, for people."""
        return self.kind.title

    @property
    def rmse(self) -> float:
        """N"""
        return float(np.sqrt(np.mean(self.residuals**2)))


def fit_rival(kind: RivalKind, trace: Trace, segments: Segments | None = None, *, seed: int = 0) -> RivalFit:
    """Fits one rival for each pop of the first insertion. A rival without a puncture is fitted once. Needs SciPy.

    Raises TraceError if the trace has no insertion.
    """
    segments = segments or segment(trace)
    walls = walls_of(trace, segments, one=not kind.punctures)
    path = path_of(trace, segments)
    rows = _searched(trace, walls)
    few = Problem(kind, _thin(path, rows), [_moved(wall, rows) for wall in walls])
    x, punctured, converged, costs = _search(few, trace.force[rows], seed)
    every = Problem(kind, path, walls)
    at = [None if i is None else int(rows[i]) for i in punctured]
    x, converged = _solve(every, trace.force, every.from_other(few, x), at, 30)
    at = _best_punctures(every, trace.force, x, at)
    x, converged = _solve(every, trace.force, x, at, 60)
    force = every.force(x, at)
    layers = every.layers(x, at)
    best = min(costs)
    masks = [mask[rows] for mask in held_out(len(trace), segments)]
    return RivalFit(
        kind=kind,
        layers=layers,
        parameters=every.parameters,
        force=force,
        residuals=trace.force - force,
        converged=converged,
        agreeing=sum(cost <= 1.01 * best + 1e-12 for cost in costs),
        starts=len(costs),
        held_out_rmse=_held_out(few, trace.force[rows], few.from_other(every, x), punctured, masks),
        surface=layers[0].surface,
    )


Punctures = list[int | None]


def _search(problem: Problem, force: Array, seed: int) -> tuple[Array, Punctures, bool, list[float]]:
    """The best of several starts, with its punctures; and the sum of squares of each start, N^2."""
    rng = np.random.default_rng(seed)
    best, costs = None, []
    for i in range(STARTS if len(problem.walls) < 3 else 3):
        x = problem.first if i == 0 else problem.other_start(rng)
        at: Punctures = [wall.punctured for wall in problem.walls]
        x, _ = _solve(problem, force, x, at, 12)
        at = _best_punctures(problem, force, x, at)
        x, converged = _solve(problem, force, x, at, 30)
        cost = float(np.sum((problem.force(x, at) - force) ** 2))
        costs.append(cost)
        if best is None or cost < best[3]:
            best = (x, at, converged, cost)
    assert best is not None
    return best[0], best[1], best[2], costs


def _solve(
    problem: Problem,
    force: Array,
    x: Array,
    at: Sequence[int | None],
    calls: int,
    seen: NDArray[np.bool_] | None = None,
) -> tuple[Array, bool]:
    """Bounded least squares from x. seen (n,): the samples that count. Returns x, and whether it is an optimum."""
    least_squares = optional("scipy.optimize", "identify", "the fit of a rival").least_squares
    use = slice(None) if seen is None else seen
    size = max(float(np.max(np.abs(force))), 1e-9)

    def errors(values: Array) -> Array:
        return np.asarray((problem.force(values, at)[use] - force[use]) / size)

    def slopes(values: Array) -> Array:
        return np.asarray(problem.slopes(values, at)[use] / size)

    found = least_squares(
        errors, x, slopes, bounds=(problem.low, problem.high), max_nfev=calls, x_scale="jac", ftol=1e-7, xtol=1e-7
    )
    return np.asarray(found.x), bool(found.success)


def _best_punctures(problem: Problem, force: Array, x: Array, at: Sequence[int | None]) -> Punctures:
    """Moves each puncture over the samples of its drop to the one with the least error."""
    best = list(at)
    if not problem.kind.punctures:
        return best
    for i, wall in enumerate(problem.walls):
        if wall.punctured is None:
            continue
        first, last = max(1, wall.punctured - 4), min(len(force) - 1, wall.punctured + 8)
        errors = {}
        for sample in range(first, last + 1):
            tried = [*best[:i], sample, *best[i + 1 :]]
            errors[sample] = float(np.sum((problem.force(x, tried) - force) ** 2))
        best[i] = min(errors, key=errors.__getitem__)
    return best


def _held_out(problem: Problem, force: Array, x: Array, at: Punctures, masks: Sequence[NDArray[np.bool_]]) -> float:
    """Root mean square error, N, of samples that the fit did not see."""
    squares = []
    for out in masks:
        found, _ = _solve(problem, force, x, at, 10, ~out)
        squares.append((problem.force(found, at) - force)[out] ** 2)
    return float(np.sqrt(np.mean(np.concatenate(squares)))) if squares else float("nan")


def _searched(trace: Trace, walls: Sequence[Wall]) -> NDArray[np.int64]:
    """The samples that a search uses: evenly over the trace, and all near a puncture."""
    n = len(trace)
    if n <= SEARCHED:
        return np.arange(n)
    near = [np.arange(max(0, w.punctured - 5), min(n, w.punctured + 10)) for w in walls if w.punctured is not None]
    return np.unique(np.concatenate([np.linspace(0, n - 1, SEARCHED).astype(np.int64), *near]))


def _thin(path: Path, rows: NDArray[np.int64]) -> Path:
    time = np.cumsum(path.period)[rows]
    period = np.diff(time, prepend=time[0] - path.period[0])
    return replace(path, depth=path.depth[rows], velocity=path.velocity[rows], period=period)


def _moved(wall: Wall, rows: NDArray[np.int64]) -> Wall:
    return wall if wall.punctured is None else replace(wall, punctured=int(np.searchsorted(rows, wall.punctured)))

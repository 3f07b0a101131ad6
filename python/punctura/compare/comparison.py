"""The curves of several runs on one axis, with their mean."""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from punctura.compare.run import Array, Run
from punctura.compare.statistics import Statistics, statistics

POINTS = 400  # of a curve
NUMBERS = (
    "duration", "depth", "peak", "felt_peak", "drop", "overshoot", "work", "felt_work",
    "thumb_peak", "pressure_peak", "plunger_travel",
)  # of Statistics  # fmt: skip
OF_PLUNGER = ("thumb", "pressure", "plunger")  # bands that only runs with a syringe have
On = Literal["depth", "time"]


@dataclass(frozen=True)
class Summary:
    """A number over several runs. SI; None where there are too few runs."""

    n: int
    mean: float | None
    deviation: float | None  # sample standard deviation, n - 1


@dataclass
class Band:
    """One quantity of all runs on a common axis: n(x) runs have a value at x. SI; NaN where a run has none."""

    x: Array  # (points,)
    runs: Array = field(repr=False)  # (runs, points)

    @property
    def count(self) -> Array:
        """(points,), the number of runs that have a value."""
        counted: Array = np.isfinite(self.runs).sum(axis=0)
        return counted

    @property
    def stretches(self) -> list[slice]:
        """The stretches of x in which as many runs have a value, two or more: between them the mean jumps."""
        count = self.count
        edges = [0, *(np.flatnonzero(np.diff(count)) + 1).tolist(), len(count)]
        return [slice(a, b) for a, b in itertools.pairwise(edges) if count[a] > 1]

    @property
    def mean(self) -> Array:
        """(points,), NaN where no run has a value."""
        with np.errstate(invalid="ignore"):
            mean: Array = np.nansum(self.runs, axis=0) / np.where(self.count, self.count, np.nan)
        return mean

    @property
    def deviation(self) -> Array:
        """(points,), the sample standard deviation (n - 1); NaN where fewer than two runs have a value."""
        squares = np.nansum((self.runs - self.mean) ** 2, axis=0)
        deviation: Array = np.sqrt(squares / np.where(self.count > 1, self.count - 1, np.nan))
        return deviation


@dataclass
class Comparison:
    """Several runs. `bands` holds a Band for each of "model", "felt", "force_limit" and, against time, "depth".
    If a run has a syringe, also "thumb", N, "pressure", Pa, and "plunger", m.

    `membranes` holds one Band for each membrane of the first run: the model's resistance along the needle against the
    membrane's own depth, or against time. It is empty if the runs do not have the same membranes.
    """

    on: On  # what the curves are drawn against
    statistics: list[Statistics]  # one for each run
    bands: dict[str, Band]
    membranes: list[Band]  # the band of each membrane's law
    names: list[str]  # of the membranes

    def difference(self, row: int) -> dict[str, float | None]:
        """The numbers (NUMBERS) of a run minus those of the first run; None where one of the two has no value."""
        first, other = self.statistics[0], self.statistics[row]
        pairs = {name: (getattr(first, name), getattr(other, name)) for name in NUMBERS}
        return {name: None if a is None or b is None else b - a for name, (a, b) in pairs.items()}

    def summary(self) -> dict[str, Summary]:
        """Mean, sample standard deviation and number of runs of each of NUMBERS."""
        columns = {name: [getattr(one, name) for one in self.statistics] for name in NUMBERS}
        return {name: _summary([v for v in values if v is not None]) for name, values in columns.items()}


def _summary(values: list[float]) -> Summary:
    n = len(values)
    return Summary(n, float(np.mean(values)) if n else None, float(np.std(values, ddof=1)) if n > 1 else None)


class Collector:
    """Takes runs one after the other, and keeps only their curves and numbers: a long recording needs much memory."""

    def __init__(self, on: On, points: int = POINTS) -> None:
        if on not in ("depth", "time"):
            raise ValueError(f'on must be "depth" or "time", not {on!r}')
        self._on, self._points = on, points
        self._numbers: list[Statistics] = []
        self._places: list[tuple[str, ...]] = []
        self._curves: list[dict[str, tuple[Array, Array]]] = []

    def add(self, run: Run) -> None:
        """Raises TypeError for something else than a Run."""
        if not isinstance(run, Run):
            raise TypeError(
                f"a run to compare must be a Run, not {type(run).__name__}; "
                "Run.of_ticks(name, scene, ticks) makes one of Ticks, recorded_run(path) one of a recording"
            )
        places = tuple(placed.name for placed in run.scene.membranes)
        self._numbers.append(statistics(run))
        self._places.append(places)
        self._curves.append(_curves(run, self._on, len(places)))

    def comparison(self) -> Comparison:
        """Raises ValueError for no runs."""
        if not self._numbers:
            raise ValueError("there are no runs to compare")
        first = self._places[0]
        same = all(places == first for places in self._places)
        named = [name for name in self._curves[0] if not name.isdigit()]
        each = [str(i) for i in range(len(first))] if same else []
        bands = {name: _band([own[name] for own in self._curves], self._points) for name in [*named, *each]}
        named = [name for name in named if name not in OF_PLUNGER or np.isfinite(bands[name].runs).any()]
        return Comparison(
            self._on, self._numbers, {name: bands[name] for name in named}, [bands[i] for i in each], list(first)
        )


def compare(runs: Iterable[Run], on: On = "depth", points: int = POINTS) -> Comparison:
    """Compares runs. Raises ValueError for no runs, TypeError for something else than a Run.

    on "time": the time since the first contact, s. on "depth": the depth, m; a curve has the values at the moment when
    the tip first came to each depth, so that there is one value for each depth.
    """
    collector = Collector(on, points)
    for run in runs:
        collector.add(run)
    return collector.comparison()


def _curves(run: Run, on: On, membranes: int) -> dict[str, tuple[Array, Array]]:
    """x and y of each quantity, x without gaps and increasing, thinned to what POINTS can show."""
    rows = slice(run.touch, None)
    totals = {"model": run.model[rows], "felt": run.felt[rows], "force_limit": run.force_limit[rows]}
    totals |= {name: getattr(run, name)[rows] for name in OF_PLUNGER}
    each = range(min(membranes, run.forces.shape[1]))
    if on == "time":
        x = run.time[rows] - run.time[run.touch]
        whole = totals | {"depth": run.depth[rows]} | {str(i): run.forces[rows, i] for i in each}
        return {name: (x, y) for name, y in whole.items()}
    found = {name: _first_passage(run.depth[rows], y) for name, y in totals.items()}
    return found | {str(i): _first_passage(run.depths[rows, i], run.forces[rows, i]) for i in each}


def _first_passage(depth: Array, values: Array) -> tuple[Array, Array]:
    """The rows in which the depth is larger than ever before, from the surface on."""
    known = np.where(np.isfinite(depth), depth, -np.inf)
    before = np.maximum.accumulate(np.concatenate([[0.0], known[:-1]]))
    ahead = known > before
    return depth[ahead], values[ahead]


def _band(curves: list[tuple[Array, Array]], points: int) -> Band:
    end = max((float(x[-1]) for x, _ in curves if len(x)), default=0.0)
    grid = np.linspace(0.0, end, points)
    return Band(grid, np.stack([_resampled(x, y, grid) for x, y in curves]))


def _resampled(x: Array, y: Array, grid: Array) -> Array:
    """y at the places of the grid, between the samples linearly; NaN outside the samples."""
    if len(x) < 2 or not np.isfinite(y).any():
        return np.full(len(grid), np.nan)
    step = grid[1] - grid[0] if len(grid) > 1 else 0.0
    return np.interp(grid, x, y, left=np.nan if x[0] > step else y[0], right=np.nan)

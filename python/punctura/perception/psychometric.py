"""The psychometric function, and its posterior on a grid of parameters.

One grid serves QUEST+ (A. B. Watson, Journal of Vision 17(3):10, 2017) and the fit of the analysis, which is Bayesian
as in H. H. Schütt, S. Harmeling, J. H. Macke, F. A. Wichmann, Vision Research 122 (2016). docs/decisions/perception.md
says why neither library is used.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.special import ndtr, ndtri

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Shape:
    """How the probability of the counted answer goes with the level.

    Without `one_sided` it is that of "yes" or of "the comparison": it crosses 1/2 at the threshold, a normal function.
    With it, it is that of a right answer: a Weibull function of the distance from the reference, half-way between guess
    and 1 at the threshold.
    """

    guess: float  # probability of the counted answer of a person who only guesses
    one_sided: bool = False
    rises: bool = True  # with the level
    reference: float = 0.0  # level at which nothing differs
    log: bool = False  # a normal function of the level's logarithm
    floor: bool = False  # the probability may end at more than 0: false alarms

    def axis(self, levels: npt.ArrayLike) -> Array:
        """The variable in which the function has a place and a width, of each level."""
        x = np.asarray(levels, np.float64)
        with np.errstate(divide="ignore"):
            if self.one_sided:
                return np.log(np.abs(x - self.reference))
            return np.log(x) if self.log else x.copy()

    def level(self, u: npt.ArrayLike) -> Array:
        """The distance from the reference (one-sided) or the level of a value of `axis`."""
        x = np.asarray(u, np.float64)
        return np.exp(x) if self.one_sided or self.log else x.copy()


class Sizes(NamedTuple):
    """Number of values of each parameter."""

    place: int = 41
    width: int = 19
    lapse: int = 5
    floor: int = 5


FIT, QUEST = Sizes(), Sizes(31, 10, 3, 3)
MOST_LAPSE, MOST_FLOOR = 0.25, 0.45


class Grid:
    """Combinations of parameters, each with its prior: (cells,) each."""

    def __init__(self, shape: Shape, levels: npt.ArrayLike, sizes: Sizes = FIT, near: Sequence[Array] = ()) -> None:
        """levels: those that are shown. near: bounds of place, log of width, lapse and floor; default: wide ones."""
        self.shape = shape
        shown = shape.axis(levels)
        shown = shown[np.isfinite(shown)]
        low, high = float(shown.min()), float(shown.max())
        self.low, self.high = low, high
        spread = self.spread = high - low
        widest: Sequence[Array | tuple[float, float]] = (
            (low - spread / 2, high + spread / 2),
            np.log(spread * np.array([0.02, 2.0])),
            (0.0, MOST_LAPSE),
            (0.0, MOST_FLOOR),
        )
        axes = [np.linspace(ends[0], ends[1], count) for ends, count in zip(near or widest, sizes, strict=True)]
        if not shape.floor:
            axes[3] = np.zeros(1)
        self.parts = [part.ravel() for part in np.meshgrid(*axes, indexing="ij")]  # as near
        self.place, width, self.lapse, self.floor = self.parts
        self.width = np.exp(width)
        outside = np.maximum(np.maximum(low - self.place, self.place - high), 0) / (spread / 2)
        prior = (1 + np.cos(np.pi * np.minimum(outside, 1))) * (1 - self.lapse) ** 9  # the width's is flat in its log
        prior = prior * (1 - self.floor)
        if shape.one_sided:
            prior = prior * np.sqrt(shape.level(self.place))  # between flat in the distance and in its logarithm
        self.prior: Array = prior / prior.sum()
        # Where the function of place and width has the probability 1/2, less its place, in widths: with a floor the
        # place is that of half the answers, else the floor would move it.
        self._shift = ndtri((0.5 - self.floor) / (1 - self.floor))

    def probability(self, levels: npt.ArrayLike) -> Array:
        """Of the counted answer: (levels, cells)."""
        u = self.shape.axis(levels)[:, None]
        z = (u - self.place) / self.width * (1 if self.shape.rises else -1)
        if self.shape.one_sided:
            core = self.shape.guess + (1 - self.shape.guess) * -np.expm1(-np.log(2) * np.exp(np.minimum(z, 30)))
        else:
            core = self.floor + (1 - self.floor) * ndtr(z + self._shift)
        found: Array = (1 - self.lapse) * core + self.lapse * self.shape.guess
        return np.clip(found, 1e-9, 1 - 1e-9)


class Belief(NamedTuple):
    """A grid and the probability of each of its cells."""

    grid: Grid
    weight: Array  # (cells,)

    def quantiles(self, values: Array, shares: Sequence[float]) -> Array:
        """Of a quantity that has `values` (cells,)."""
        unique, at = np.unique(values, return_inverse=True)
        mass = np.bincount(at, self.weight, len(unique))
        below = np.cumsum(mass) - mass / 2  # half of a cell lies below its middle
        found: Array = np.interp(shares, below, unique)
        return found

    def mean(self, values: Array) -> float:
        return float(self.weight @ values)


def posterior(shape: Shape, levels: npt.ArrayLike, shown: npt.ArrayLike, counted: npt.ArrayLike) -> Belief:
    """The belief after trials. levels: all that could be shown. shown, counted (n,): of each trial.

    A second grid is finer where the first one has its weight.
    """
    at, each = np.unique(np.asarray(shown, np.float64), return_inverse=True)
    total = np.bincount(each, minlength=len(at)).astype(np.float64)
    hits = np.bincount(each, np.asarray(counted, np.float64), len(at)).astype(np.float64)
    belief = _weighed(Grid(shape, levels), at, hits, total)
    near = [_around(belief, values) for values in belief.grid.parts]
    return _weighed(Grid(shape, levels, FIT, near), at, hits, total)


def _weighed(grid: Grid, at: Array, hits: Array, total: Array) -> Belief:
    p = grid.probability(at)
    log = hits @ np.log(p) + (total - hits) @ np.log1p(-p) + np.log(np.maximum(grid.prior, 1e-300))
    weight = np.exp(log - log.max())
    return Belief(grid, weight / weight.sum())


def _around(belief: Belief, values: Array) -> Array:
    """The bounds of the values that have any weight, and one value more on either side."""
    unique, at = np.unique(values, return_inverse=True)
    heavy = np.flatnonzero(np.bincount(at, belief.weight, len(unique)) > 1e-5)
    return unique[[max(heavy[0] - 1, 0), min(heavy[-1] + 1, len(unique) - 1)]]

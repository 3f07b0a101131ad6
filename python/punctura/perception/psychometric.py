"""The psychometric function, and its posterior on a grid of parameters.

One grid serves QUEST+ (A. B. Watson, Journal of Vision 17(3):10, 2017) and the fit of the analysis, which is Bayesian
as in H. H. Schütt, S. Harmeling, J. H. Macke, F. A. Wichmann, Vision Research 122 (2016). docs/decisions/perception.md
says why neither library is used.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.special import ndtr, ndtri

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Shape:
    """How the probability of the counted answer goes with the level.

    Without `one_sided` it is that of "yes" or of "the comparison": it crosses 1/2 at the threshold, a normal function.
    With it, it is that of a right answer, half-way between guess and 1 at the threshold: d' is a power of the distance
    from the reference, and the strongest of all intervals is chosen.

    `rest` is what else the answers depend on. floor: of yes or no, a probability of false alarms. bias: of two
    intervals, towards the first one, in standard deviations of what decides; else a bias would look like noise.
    """

    intervals: int = 1
    one_sided: bool = False
    rises: bool = True  # with the level
    reference: float = 0.0  # level at which nothing differs
    below: bool = False  # one-sided: the levels are below the reference
    bends: bool = False  # what z or the logarithm of d' goes with is the level, its logarithm or its reciprocal
    rest: Literal["", "floor", "bias"] = ""

    @property
    def guess(self) -> float:
        """The probability of the counted answer of a person who only guesses."""
        return 1 / max(self.intervals, 2)

    def axis(self, levels: npt.ArrayLike) -> Array:
        """The variable in which the function has a place and a width, of each level."""
        x = np.array(levels, np.float64)
        if self.one_sided:  # a difference that was felt the other way round is none
            x = self.reference - x if self.below else x - self.reference
        with np.errstate(divide="ignore"):
            return np.log(np.maximum(x, 0.0)) if self.one_sided else x

    def level(self, u: npt.ArrayLike) -> Array:
        """The distance from the reference (one-sided) or the level of a value of `axis`."""
        x = np.asarray(u, np.float64)
        return np.exp(x) if self.one_sided else x.copy()


class Sizes(NamedTuple):
    """Number of values of each parameter."""

    place: int
    width: int
    rest: int
    lapse: int


FIT = (Sizes(25, 13, 5, 6), Sizes(21, 11, 5, 7), Sizes(21, 11, 7, 10))  # each finer where the last one has its weight
MORE, LEAST_STEPS = 5, 1.5  # such grids at most, until the weight has so many steps: many answers leave it little room
QUEST = Sizes(61, 9, 3, 3)
MOST_LAPSE, MOST_FLOOR, MOST_BIAS = 0.25, 0.45, 2.0
BIAS = 0.7  # standard deviation of its prior
LAPSES = 50  # their prior is a beta distribution of 1 and this
EXPONENT, EXPONENTS = 1.0, 0.5  # of d': the middle of its prior, and the standard deviation of its logarithm
BENDS = (1, 0, -1)  # power of the level that `bends` means; 0: its logarithm
QUARTER = float(ndtri(0.75))  # widths from the place to the level of 75 %
_Z = np.linspace(-8, 8, 801)
_DPRIMES = np.linspace(0, 12, 1201)


def strongest(gap: Array, own: npt.ArrayLike, other: npt.ArrayLike, intervals: int) -> Array:
    """The probability that the comparison is felt as the strongest of all intervals.

    gap: how much stronger it is. own, other: standard deviations of what is felt of it, and of each other interval.
    """
    if intervals == 2:
        return np.asarray(ndtr(gap / np.hypot(own, other)))
    beats = ndtr((gap[..., None] + np.multiply.outer(own, _Z)) / np.expand_dims(other, -1)) ** (intervals - 1)
    return np.asarray(beats @ np.exp(-_Z * _Z / 2) * (_Z[1] - _Z[0]) / np.sqrt(2 * np.pi))


@cache
def _right(intervals: int) -> tuple[Array, float]:
    """The probability of a right answer at each of _DPRIMES, and the d' at the threshold."""
    p = strongest(_DPRIMES, np.ones_like(_DPRIMES), 1.0, intervals)
    return p, float(np.interp((1 + 1 / intervals) / 2, p, _DPRIMES))


class Grid:
    """Combinations of parameters, each with its prior: (cells,) each."""

    def __init__(
        self, shape: Shape, levels: npt.ArrayLike, sizes: Sizes, near: Sequence[tuple[float, float]] = ()
    ) -> None:
        """levels: those that are shown. near: bounds of place, log of width, rest and root of lapse; default: wide."""
        self.shape = shape
        shown = shape.axis(levels)
        shown = shown[np.isfinite(shown)]
        low, high = float(shown.min()), float(shown.max())
        self.low, self.high = low, high
        spread = self.spread = high - low
        lowest = max(low - spread / 2, low / 4) if shape.bends and not shape.one_sided else low - spread / 2
        widest: Sequence[tuple[float, float]] = (
            (lowest, high + spread / 2),
            (np.log(1 / 12), np.log(3.0)) if shape.one_sided else (np.log(0.02 * spread), np.log(2.0 * spread)),
            (0.0, MOST_FLOOR) if shape.rest == "floor" else (-MOST_BIAS, MOST_BIAS),
            (0.0, np.sqrt(MOST_LAPSE)),
        )
        self.ends = widest
        axes = [np.linspace(ends[0], ends[1], count) for ends, count in zip(near or widest, sizes, strict=True)]
        self.step = float(axes[1][1] - axes[1][0])  # of the logarithm of the width
        if not shape.rest:
            axes[2] = np.zeros(1)
        axes.insert(3, np.array(BENDS if shape.bends else BENDS[:1], np.float64))
        *parts, self.bend, root = [part.ravel() for part in np.meshgrid(*axes, indexing="ij")]
        self.parts = [*parts, root]  # as near
        self.place, width, rest = parts
        self._lapses = len(axes[4])
        self.width, self.lapse = np.exp(width), root**2
        self.narrowest, self.widest = (float(end) for end in np.exp(widest[1]))
        self.bias = rest if shape.rest == "bias" else np.zeros(1)
        self.floor = rest if shape.rest == "floor" else np.zeros(1)
        outside = np.maximum(np.maximum(low - self.place, self.place - high), 0) / (spread / 2)
        prior = (1 + np.cos(np.pi * np.minimum(outside, 1))) * root * (1 - self.lapse) ** (LAPSES - 1)
        prior = prior * (1 - self.floor) * np.exp(-((self.bias / BIAS) ** 2) / 2)
        if shape.one_sided and shape.bends:  # the width is one over the exponent of d', whose prior is flat
            prior = prior / self.width
        elif shape.one_sided:
            prior = prior * np.exp(-(((width + np.log(EXPONENT)) / EXPONENTS) ** 2) / 2)
        elif shape.rest != "floor":  # flat in a width that is wanted, else in its logarithm
            prior = prior * self.width
        self.prior: Array = prior / prior.sum()
        # Where the function of place and width has the probability 1/2, less its place, in widths: with a floor the
        # place is that of half the answers, else the floor would move it.
        self._shift = ndtri((0.5 - self.floor) / (1 - self.floor))

    def probability(self, levels: npt.ArrayLike, sides: npt.ArrayLike = 0.0) -> Array:
        """Of the counted answer: (levels, cells). sides: 1 where the first interval is the counted one, -1 the second.

        Without `sides` it is that of a person without bias.
        """
        n = self._lapses  # next to each other are cells that differ in the lapses alone
        u = self.shape.axis(levels)[:, None]
        place = self.place[::n]
        away = u - place
        if self.shape.bends:  # all with the same place, and the same slope there
            one_sided, bend = self.shape.one_sided, self.bend[::n]
            log = np.clip(away if one_sided else np.log(np.maximum(u / place, 1e-9)), -30, 30)
            bent = np.where(bend > 0, np.expm1(log), np.where(bend == 0, log, -np.expm1(-log)))
            away = bent if one_sided else place * bent
        z = away / self.width[::n] * (1 if self.shape.rises else -1)
        bias = np.reshape(sides, (-1, 1)) * self.bias[::n]
        if self.shape.one_sided:
            p, middle = _right(self.shape.intervals)
            dprime = middle * np.exp(np.minimum(z, 30))
            two = self.shape.intervals == 2
            core = ndtr(dprime / np.sqrt(2) + bias) if two else np.interp(dprime, _DPRIMES, p)
        else:
            floor = self.floor[::n]
            core = floor + (1 - floor) * ndtr(z + self._shift[::n] + bias)
        return self._lapsed(np.repeat(core, n, axis=1))

    def jnd(self) -> Array:
        """Half the distance between the levels of 25 and 75 %, of each cell. For a shape without a floor."""
        step: Array = QUARTER * self.width
        if not self.shape.bends:
            return step
        share = np.minimum(step / self.place, 0.99)  # with the reciprocal no level may reach 75 %
        bent = np.where(self.bend == 0, np.sinh(share), share / (1 - share**2))
        found: Array = np.where(self.bend > 0, step, self.place * bent)
        return found

    def caught(self) -> Array:
        """The probability of a yes without what is asked for: (cells,)."""
        return self._lapsed(self.floor)

    def _lapsed(self, core: Array) -> Array:
        found: Array = (1 - self.lapse) * core + self.lapse * self.shape.guess
        return np.clip(found, 1e-9, 1 - 1e-9)


class Belief(NamedTuple):
    """A grid and the probability of each of its cells."""

    grid: Grid
    weight: Array  # (cells,)

    def marginal(self, values: Array) -> tuple[Array, Array]:
        """The different ones of `values` (cells,), and the probability of each."""
        unique, at = np.unique(values, return_inverse=True)
        return unique, np.bincount(at, self.weight, len(unique)).astype(np.float64)

    def quantiles(self, values: Array, shares: Sequence[float]) -> Array:
        """Of a quantity that has `values` (cells,)."""
        unique, mass = self.marginal(values)
        below = np.cumsum(mass) - mass / 2  # half of a cell lies below its middle
        found: Array = np.interp(shares, below, unique)
        return found

    def jnd(self, shares: Sequence[float]) -> Array:
        """Quantiles of the just noticeable difference. A width stands for all up to half a step from it: as single
        values, those of the three shapes would lie in few heaps."""
        unique, mass = self.marginal(np.log(self.grid.jnd()))
        step = self.grid.step
        at = np.linspace(unique[0] - step, unique[-1] + step, 401)
        below = np.clip((at[:, None] - unique) / step + 0.5, 0.0, 1.0) @ mass
        return np.exp(np.interp(shares, below, at))

    def density(self, values: Array, at: float) -> float:
        """Of the probability of the values at one of them, as a share of the largest; 0 outside the grid."""
        unique, mass = self.marginal(values)
        return float(mass[np.isclose(unique, at)].sum() / mass.max())

    def likelihood(self, values: Array, at: float) -> float:
        """Of one of the values, as a share of the largest: how well the answers agree; 0 outside the grid."""
        unique, mass = self.marginal(values)
        found = mass / self._replace(weight=self.grid.prior).marginal(values)[1]
        return float(found[np.isclose(unique, at)].sum() / found[mass > 1e-9].max())

    def mean(self, values: Array) -> float:
        return float((self.weight * values).sum())  # BLAS would start threads for it


def posterior(
    shape: Shape, levels: npt.ArrayLike, shown: npt.ArrayLike, counted: npt.ArrayLike, sides: npt.ArrayLike = 0.0,
    catch: tuple[float, float] = (0, 0),
) -> Belief:  # fmt: skip
    """The belief after trials. levels: all that could be shown. shown, counted, sides (n,): of each trial.

    catch: how often "yes" was answered without what is asked for, and the number of these trials.
    """
    trials = np.column_stack(np.broadcast_arrays(np.asarray(shown, np.float64), sides))
    cells, each = np.unique(trials, axis=0, return_inverse=True)
    hits = np.bincount(each.ravel(), np.asarray(counted, np.float64), len(cells))
    total = np.bincount(each.ravel(), minlength=len(cells))
    near: list[tuple[float, float]] = []
    for sizes in FIT + FIT[-1:] * MORE:
        grid = Grid(shape, levels, sizes, near)
        p, caught = grid.probability(cells[:, 0], cells[:, 1]), grid.caught()
        log = hits @ np.log(p) + (total - hits) @ np.log1p(-p) + np.log(np.maximum(grid.prior, 1e-300))
        log = log + catch[0] * np.log(caught) + (catch[1] - catch[0]) * np.log1p(-caught)
        weight = np.exp(log - log.max())
        belief = Belief(grid, weight / weight.sum())
        around = [_around(belief, *part) for part in zip(grid.parts, grid.ends, strict=True)]
        near = [bounds for bounds, _ in around]
        if sizes is FIT[-1] and all(enough for _, enough in around):
            break
    return belief


def _around(belief: Belief, values: Array, ends: tuple[float, float]) -> tuple[tuple[float, float], bool]:
    """The bounds of the values that have any weight, and some more on either side; whether the values were fine enough
    and reached far enough. ends: those of the prior."""
    unique, mass = belief.marginal(values)
    heavy, last = np.flatnonzero(mass > 1e-3)[[0, -1]], len(unique) - 1
    step = float(unique[-1] - unique[0]) / max(last, 1)
    cut = heavy[0] == 0 and unique[0] > ends[0], heavy[1] == last and unique[-1] < ends[1]
    low, high = (float(unique[i]) for i in heavy)
    bounds = max(low - step * (1 + 2 * cut[0]), ends[0]), min(high + step * (1 + 2 * cut[1]), ends[1])
    return bounds, last == 0 or not (any(cut) or high - low < LEAST_STEPS * step)

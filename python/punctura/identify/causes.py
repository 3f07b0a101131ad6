"""What could explain what a model leaves: each cause is fitted to the residuals beside the model's own parameters.

Also whether the way out resists as much as the way in, at the same depth.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from punctura.identify.explained import Blocks, Explained, in_air
from punctura.identify.fit import Fit
from punctura.trace import Segments, Trace

UNEVEN = 0.1  # of the force, by which both ways must differ
FEWEST = 10  # samples of each way
PROPORTIONAL = 0.5  # of the growth of a force in proportion to the depth: more is no friction
SHALLOW = 0.5  # of the way behind the pop: deeper, another wall may resist, and the spring unloads


class Ways(NamedTuple):
    """The force of the shaft on both ways at the same depths."""

    ratio: float  # out over in; K06 has 1
    difference: float  # N, in less out
    growth: float  # N/m, of a force that has the same sign on both ways; 0: it is friction that differs
    zeros: tuple[float, float]  # the ratios with the zero of each end

    @property
    def uneven(self) -> bool:
        """Whether both ways differ, wherever the zero of the force is between those of both ends."""
        return min(self.zeros) > 1 + UNEVEN or max(self.zeros) < 1 - UNEVEN


def both_ways(trace: Trace, segments: Segments, fit: Fit) -> Ways | None:
    """The mean force of the shaft on both ways behind the last pop, in the first insertion.

    None if the trace does not show both ways there, or no air, or if the next wall resists there. No law is used.
    """
    strokes = [stroke for stroke in segments.strokes if stroke.insertion == 0]
    ends = [stroke.end for stroke in strokes if stroke.kind == "in"]  # some in air, where a hand turns
    end = max(ends, key=lambda i: trace.depth[i - 1], default=0)
    pops = [pop for pop in segments.pops if pop.start < end]
    if not pops:
        return None
    last = min(strokes[-1].end, len(trace))
    begin = float(trace.depth[pops[-1].end]) + pops[-1].width
    deep = begin + SHALLOW * (float(trace.depth[:end].max()) - begin)
    air = in_air(trace, segments, fit)
    if air.sum() < FEWEST:
        return None
    force = trace.force - fit.misfit.of_rig(fit.parameters)
    force = force - float(np.median(force[air]))
    levels = ([] if segments.contact is None else [slice(segments.contact + 1)]) + (
        [] if segments.exit is None else [slice(segments.exit, None)]
    )
    zeros = [float(np.median(force[one])) for one in levels] or [0.0]
    within = np.arange(len(trace))
    halves = []
    for low, high in ((begin, 0.5 * (begin + deep)), (0.5 * (begin + deep), deep)):
        there = (trace.depth > low) & (trace.depth < high)
        going, coming = force[there & (within < end)], force[there & (within >= end) & (within < last)]
        if 2 * min(len(going), len(coming)) < FEWEST or not np.mean(going) > 0:
            return None
        halves.append((float(np.mean(going)), float(-np.mean(coming))))
    shift = 0.25 * (deep - begin) + begin - float(trace.depth[segments.contact or 0])  # depth of the first half
    step = 0.5 * (deep - begin)
    ratios = [out / inside for inside, out in halves]
    if abs(ratios[0] - ratios[1]) > 0.5 * max(abs(ratios[0] - 1), abs(ratios[1] - 1), UNEVEN):
        return None  # it grows with the depth, as where the next wall resists on the way in
    going_in, coming_out = np.mean(halves, axis=0)
    least, most = ((coming_out + zero) / max(going_in - zero, 1e-300) for zero in (min(zeros), max(zeros)))
    (same, more), (friction, other) = (0.5 * np.array([a - sign * b for a, b in halves]) for sign in (1, -1))
    rise = more - same
    grows = rise * same > PROPORTIONAL * same**2 * step / shift and abs(other - friction) < 0.5 * abs(rise)
    growth = float(rise / step) if grows else 0.0
    return Ways(float(coming_out / going_in), float(going_in - coming_out), growth, (float(least), float(most)))


def way_out(ratio: float, growth: float = 0.0) -> tuple[str, str]:
    """The name of an asymmetric way out, and a sentence with what could make it and what would tell.

    growth: see Ways.
    """
    if growth:
        return "same_both_ways", (
            f"A force that is the same on both ways changes with the depth, by {1e-3 * growth:+.2g} N a mm, and K06 "
            "has none. Crosstalk from a side force, a cable that pulls, or a layer that is pressed together do this. "
            "To tell: move the needle over the same depths in air, and insert once more with the rig turned half round"
        )
    words = f"The way out is asymmetric: it resists {max(ratio, 0.0):.2g} times as much as the way in, and K06 has 1"
    if ratio > 1:
        return "barbs", (
            f"{words}. Barbs, a bent or rough tip, or tissue that closes behind it do this, and so does a sensor that "
            "shows too little of a large push. To tell: withdraw a smooth needle of the same diameter, and load the "
            "sensor with weights, up to the greatest force, both ways"
        )
    return "asymmetric_way_out", (
        f"{words}. A hole that stays open, a cutting force or a wetted shaft do this. To tell: go in and out a second "
        "time at the same place"
    )


Array = NDArray[np.float64]

ENOUGH = 0.3  # of what is left: a cause that explains less is not named
BESIDE = 0.7  # of the share of the best cause: as good a cause
KNOTS = 16  # of a free profile of one way, at most


@dataclass(frozen=True)
class Cause:
    """Something that K06 does not know. share: of what is left, that it would explain; 0: it was seen otherwise."""

    kind: str
    share: float
    text: str

    def __str__(self) -> str:
        if self.share == 0:
            return self.text
        return f"{self.text}. It would explain {100 * self.share:.0f} % of what is left"


@dataclass(frozen=True, eq=False)
class _Left:
    """What is left in each block (b,), and what it may depend on."""

    left: Array  # N
    by_fit: Array  # (b, p) derivatives of the model's force by its parameters
    force: Array  # N, of the model, without the sensor's offset
    depth: Array  # m
    speed: Array | None  # m/s
    kinds: NDArray[np.str_]
    insertions: NDArray[np.int64]

    def cost(self, *columns: Array) -> float:
        """The squares that are left beside the model's parameters and these columns (b,), N^2."""
        known = np.column_stack((self.by_fit, *columns)) if columns else self.by_fit
        size = np.sqrt(np.sum(known**2, axis=0))
        known = known[:, size > 1e-9 * max(float(size.max(initial=0.0)), 1e-300)]
        known = known / np.sqrt(np.sum(known**2, axis=0))
        best = np.linalg.lstsq(known, self.left, rcond=1e-8)[0]
        return float(np.sum((self.left - known @ best) ** 2))

    def size_of(self, column: Array) -> float:
        """The factor of a column beside the model's parameters."""
        known = np.column_stack((column, self.by_fit))
        size = np.maximum(np.sqrt(np.sum(known**2, axis=0)), 1e-300)
        return float(np.linalg.lstsq(known / size, self.left, rcond=1e-8)[0][0] / size[0])


def causes(trace: Trace, segments: Segments, fit: Fit, assessment: Explained) -> tuple[Cause, ...]:
    """The causes that could explain what is left, the best one first. Empty if the trace is explained."""
    if assessment.ok:
        return ()
    of = _left(trace, segments, fit, assessment.blocks)
    chance = len(of.left) * assessment.blocks.noise**2
    before = of.cost()
    beyond = max(before - chance, 1e-300)
    ways = both_ways(trace, segments, fit)
    found = []
    for kind, text, columns in (
        *_ways(of, ways),
        *_same(of),
        *_speeds(of),
        *_again(of),
        *_ripple(of),
        *_profile(of, assessment),
    ):
        share = min((before - of.cost(*columns)) / beyond, 1.0)
        if share > ENOUGH:
            found.append(Cause(kind, share, text))
    found.sort(key=lambda cause: -cause.share)
    named = [cause for cause in found if cause.kind != "depth"]
    if named and named[0].share > BESIDE * found[0].share:  # a profile has many numbers, so it always explains some
        found = named
    return tuple(cause for cause in found if cause.share > BESIDE * found[0].share)


def _left(trace: Trace, segments: Segments, fit: Fit, blocks: Blocks) -> _Left:
    """The blocks without those that hold a pop: there, a little of the depth is much of the force."""
    pop = np.zeros(len(trace), bool)
    for one in segments.pops:
        pop[max(0, one.start - 3) : one.end + 4] = True
    kept = [i for i, (start, end) in enumerate(blocks.edges) if not pop[start:end].any()]
    edges = blocks.edges[kept]
    force = fit.misfit.forces(fit.parameters) - fit.parameters.nuisance[0]

    def means(column: Array) -> Array:
        return np.array([column[start:end].mean(axis=0) for start, end in edges])

    owners = [segments.strokes[int(i)] for i in blocks.strokes[kept]]
    return _Left(
        blocks.left[kept], means(fit.jacobian), means(force), means(trace.depth),
        None if trace.speed is None else means(trace.speed), np.array([one.kind for one in owners]),
        np.array([one.insertion for one in owners]),
    )  # fmt: skip


Tried = tuple[str, str, tuple[Array, ...]]


def _ways(of: _Left, measured: Ways | None) -> Iterator[Tried]:
    """Another size of the force on the way out. measured: of the shaft, see both_ways()."""
    out = of.kinds == "out"
    if out.sum() < 5 or (of.kinds == "in").sum() < 5:
        return
    column = np.where(out, of.force, 0.0)
    ratio = 1 + of.size_of(column) if measured is None else measured.ratio
    if abs(ratio - 1) >= UNEVEN if measured is None else measured.uneven:
        kind, text = way_out(ratio)
        yield kind, text, (column,)


def _same(of: _Left) -> Iterator[Tried]:
    """A force that depends on the depth and has the same sign on both ways."""
    if (of.kinds == "out").sum() >= 5 and (of.kinds == "in").sum() >= 5:
        kind, text = way_out(1.0, of.size_of(of.depth))
        yield kind, text, (of.depth,)


def _speeds(of: _Left) -> Iterator[Tried]:
    """A force that depends on the speed."""
    moving = of.kinds != "hold"
    if of.speed is None or not moving.any():
        return
    fast = np.abs(of.speed)
    speeds = np.sort(fast[moving])
    way = np.cumsum(speeds) / max(float(speeds.sum()), 1e-300)  # each speed counts by the way on which it was seen
    slow, usual, quick = (float(speeds[min(int(np.searchsorted(way, at)), len(way) - 1)]) for at in (0.1, 0.5, 0.9))
    if slow <= 0 or quick < 1.5 * slow:
        return
    rate = np.where(moving, np.log(np.maximum(fast, 0.02 * usual) / usual), 0.0)
    power = of.size_of(of.force * rate)
    more = f"{abs(100 * (2.0**power - 1)):.0f} % {'more' if power > 0 else 'less'} at twice the speed"
    text = (
        f"The force depends on the speed, about {more}. K06's does not. To tell: insert at three speeds, each time at a"
    )
    yield "rate", f"{text} fresh place", (of.force * rate,)


def _again(of: _Left) -> Iterator[Tried]:
    """Another size of the force after the first insertion."""
    later = of.insertions > 0
    if later.sum() < 5 or later.all():
        return
    column = np.where(later, of.force, 0.0)
    ratio = 1 + of.size_of(column)
    if abs(ratio - 1) >= UNEVEN:
        yield ("insertion", f"A later insertion resists {max(ratio, 0.0):.2g} times as much as the first one. To tell: "
               "insert a third time at the same place, and once at a fresh one", (column,))  # fmt: skip


def _ripple(of: _Left) -> Iterator[Tried]:
    """A ripple of the force over the depth, on one way or on both."""
    moving = of.kinds != "hold"
    reach = float(np.ptp(of.depth[moving])) if moving.any() else 0.0
    between = float(np.median(np.abs(np.diff(of.depth)))) if len(of.depth) > 1 else 0.0
    least = max(4 * between, reach / 60)
    if reach / 4 <= least:
        return
    best: tuple[float, float, tuple[Array, ...]] | None = None
    for period in np.geomspace(least, reach / 4, 60):
        phase = 2 * np.pi * of.depth / period
        columns = tuple(np.where(moving, of.force, 0.0) * wave for wave in (np.sin(phase), np.cos(phase)))
        cost = of.cost(*columns)
        if best is None or cost < best[0]:
            best = (cost, float(period), columns)
    assert best is not None
    text = (
        f"The force has a ripple over the depth, with a period of {best[1] * 1e3:.2g} mm, as barbs, notches of the "
        "needle or sticking and slipping make it. To tell: look at the needle, and insert at half the speed"
    )
    yield "ripple", text, best[2]


def _profile(of: _Left, assessment: Explained) -> Iterator[Tried]:
    """Any force that depends on the depth alone, on the first way in."""
    first = (of.kinds == "in") & (of.insertions == 0)
    if first.sum() < 12:
        return
    depth = of.depth
    knots = np.quantile(depth[first], np.linspace(0, 1, min(KNOTS, int(first.sum()) // 4)))
    knots = np.unique(knots)
    hats = [np.where(first, np.interp(depth, knots, np.eye(len(knots))[i]), 0.0) for i in range(len(knots))]
    inward = [place for place in assessment.places if place.kind == "in"]
    where = f" ({inward[0].shallow * 1e3:.4g} to {inward[0].deep * 1e3:.4g} mm)" if inward else ""
    text = (
        f"Another force over the depth on the way in would explain it{where}: a wall more, or another law of the "
        "tissue. To tell: --membranes with one more, punctura rivals, and a section of the tissue at this depth"
    )
    yield "depth", text, tuple(hats)

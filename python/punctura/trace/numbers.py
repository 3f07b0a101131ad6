"""The numbers of a trace that need no model: peak, gradient, pops, work."""

from dataclasses import dataclass, replace

import numpy as np

from punctura.trace.air import FEWEST, contact_sample, spread
from punctura.trace.ends import without_zero
from punctura.trace.segment import Pop, segment
from punctura.trace.trace import Trace, TraceError
from punctura.trace.turns import noise_of

LOWER, UPPER = 0.2, 0.8  # of a rise: the gradient is that of the part between them
LAST = 0.05  # of the way behind the contact: the final force is the mean over it
PARTS = 20  # of the way in: the speed is their median


@dataclass(frozen=True)
class PopNumbers:
    """A pop. SI; depths are on the axis of the trace."""

    depth_m: float
    peak_N: float
    gradient_N_per_m: float | None  # of the rise before it; None with fewer than three samples
    drop_N: float
    width_m: float


@dataclass(frozen=True)
class InsertionNumbers:
    """One insertion, with its withdrawal. SI; depths are along the needle, on the axis of the trace.

    The force is counted from zero_N, the median in air. None: the trace does not show it.
    """

    insertion: int  # 0 is the first one
    zero_N: float
    noise_N: float | None  # in air: a peak is the greatest sample, so noise makes it greater
    speed_m_per_s: float | None  # the median over equal parts of the way in
    contact_m: float | None
    deepest_m: float
    peak_N: float
    peak_depth_m: float
    peak_below_surface_m: float | None  # at a right angle to the surface, from the contact
    gradient_N_per_m: float | None  # stiffness before the peak
    work_J: float  # of the way in, from the contact to the deepest place
    final_N: float  # at the end of the way in
    withdrawal_N: float | None  # the greatest pull on the way out
    work_out_J: float | None  # of the way out; the tissue has kept or lost work_J + work_out_J
    pops: tuple[PopNumbers, ...]


def numbers_of(trace: Trace, angle: float = 0.0) -> tuple[InsertionNumbers, ...]:
    """The numbers of each insertion of a trace. angle: between the needle and the normal of the surface, rad.

    Raises TraceError for a trace without an insertion.
    """
    segments = segment(trace)
    contact = segments.contact
    before = trace.force[: 0 if contact is None else contact // 2 + 1]  # a soft layer may begin before the contact
    zero = float(np.median(before)) if len(before) and not without_zero(trace) else 0.0
    level = replace(trace, force=trace.force - zero)
    segments = segment(level)
    after = trace.force[len(trace) if segments.exit is None else segments.exit :]
    air = [spread(force) for force in (before, after) if len(force) >= FEWEST]
    noise = max(*air, noise_of(trace.force)) if air else None
    found = []
    for insertion in range(int(trace.strokes.max()) + 1):
        ways = [stroke for stroke in segments.strokes if stroke.insertion == insertion]
        inward = [stroke for stroke in ways if stroke.kind == "in"]
        if not inward:
            continue
        end = max((stroke.end for stroke in inward), key=lambda i: trace.depth[i - 1])
        start, last = ways[0].start, ways[-1].end
        touched = segments.contact if insertion == 0 else _contact(level, start, end)
        touched = None if touched is None or not start <= touched < end else touched  # the first one may stay in air
        pops = [pop for pop in segments.pops if start <= pop.start < end]
        found.append(_numbers(level, insertion, (start, end, last), touched, pops, (zero, noise), float(np.cos(angle))))
    if not found:
        raise TraceError(f"{trace.source or 'the trace'}: the needle never goes in")
    return tuple(found)


def _contact(trace: Trace, start: int, end: int) -> int | None:
    at = contact_sample(trace.depth[start:end], trace.force[start:end])
    return None if at is None else start + at


def _numbers(
    trace: Trace, insertion: int, rows: tuple[int, int, int], contact: int | None, pops: list[Pop],
    air: tuple[float, float | None], cosine: float,
) -> InsertionNumbers:  # fmt: skip
    """rows: where the way in begins, where it ends, and where the insertion ends. air: zero and noise, N."""
    (start, end, last), (zero, noise) = rows, air
    first = start if contact is None else contact
    peak = first + int(np.argmax(trace.force[first : min(end + 1, last)]))  # the deepest sample begins the next stroke
    deepest = float(trace.depth[start:last].max())
    inward = trace.depth[first:end]  # it may creep deeper in a rest
    near = inward >= inward.max() - LAST * (inward.max() - inward[0])
    outward = trace.depth[end - 1] - trace.depth[last - 1] > LAST * (deepest - trace.depth[first])
    way_out = slice(end - 1, last)
    return InsertionNumbers(
        insertion=insertion,
        zero_N=zero,
        noise_N=noise,
        speed_m_per_s=_speed(trace, slice(first, end)),
        contact_m=None if contact is None else float(trace.depth[contact]),
        deepest_m=deepest,
        peak_N=float(trace.force[peak]),
        peak_depth_m=float(trace.depth[peak]),
        peak_below_surface_m=None if contact is None else float(trace.depth[peak] - trace.depth[contact]) * cosine,
        gradient_N_per_m=_gradient(trace, max([first, *(pop.end for pop in pops if pop.end < peak)]), peak),
        work_J=_work(trace, slice(first, end)),
        final_N=float(np.mean(trace.force[first:end][near])),
        withdrawal_N=max(0.0, -float(trace.force[way_out].min())) if outward else None,
        work_out_J=_work(trace, way_out) if outward else None,
        pops=tuple(
            _pop(trace, pop, pops[i - 1].end if i else first, pops[i + 1].start if i + 1 < len(pops) else end)
            for i, pop in enumerate(pops)
        ),
    )


def _pop(trace: Trace, pop: Pop, foot: int, end: int) -> PopNumbers:
    """A pop between the samples `foot` and `end`. Its drop ends at the median behind it, not at a sample of noise."""
    behind = trace.force[pop.end : max(min(end, pop.end + max(5, pop.end - pop.start)), pop.end + 1)]
    drop = pop.force - float(np.median(behind))
    return PopNumbers(pop.depth, pop.force, _gradient(trace, foot, pop.start), drop, pop.width)


def _speed(trace: Trace, rows: slice) -> float | None:
    """The median speed, m/s, over parts of the way: with encoder steps most samples alone show no motion."""
    if trace.time is None:
        return None
    depth, first = np.unique(np.maximum.accumulate(trace.depth[rows]), return_index=True)
    way = np.linspace(depth[0], depth[-1], PARTS + 1)
    times = np.diff(np.interp(way, depth, trace.time[rows][first]))
    return float(np.median(np.diff(way) / times)) if len(depth) > 1 else None


def _work(trace: Trace, rows: slice) -> float:
    """The integral of the force over the depth, J."""
    force, depth = trace.force[rows], trace.depth[rows]  # NumPy 1.26 has no np.trapezoid
    return float(np.sum((force[1:] + force[:-1]) * np.diff(depth)) / 2)


def _gradient(trace: Trace, foot: int, top: int) -> float | None:
    """The slope of the rise from sample `foot` to `top`, N/m: a line through its middle part."""
    depth, force = trace.depth[foot : top + 1], trace.force[foot : top + 1]
    height = force - force[0]
    above = np.flatnonzero(height >= UPPER * height[-1])
    below = np.flatnonzero(height[: above[0]] <= LOWER * height[-1]) if len(above) else above
    if not len(below):
        return None
    rows = slice(int(below[-1]), int(above[0]) + 1)
    if rows.stop - rows.start < 3 or not np.ptp(depth[rows]) > 0:
        return None
    return float(np.polyfit(depth[rows], force[rows], 1)[0])

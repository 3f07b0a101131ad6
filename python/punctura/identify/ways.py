"""Whether the way out resists as much as the way in, at the same depth."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from punctura.identify.explained import in_air
from punctura.identify.fit import Fit
from punctura.trace import Segments, Trace

UNEVEN = 0.1  # of the force, by which both ways must differ
FEWEST = 10  # samples of each way
SHALLOW = 0.5  # of the way behind the pop: deeper, another wall may resist, and the spring unloads


class Ways(NamedTuple):
    """The force of the shaft on both ways at the same depths."""

    ratio: float  # out over in; K06 has 1
    difference: float  # N, in less out


def both_ways(trace: Trace, segments: Segments, fit: Fit) -> Ways | None:
    """The mean force of the shaft on both ways behind the last pop, in the first insertion.

    None if the trace does not show both ways there, or no air, or if the next wall resists there. No law is used.
    """
    strokes = [stroke for stroke in segments.strokes if stroke.insertion == 0]
    inward = [stroke for stroke in strokes if stroke.kind == "in"]
    pops = [pop for pop in segments.pops if inward and pop.start < inward[-1].end]
    if not pops:
        return None
    end = inward[-1].end
    last = min(strokes[-1].end, len(trace))
    begin = float(trace.depth[pops[-1].end]) + pops[-1].width
    deep = begin + SHALLOW * (float(trace.depth[:end].max()) - begin)
    air = in_air(trace, segments, fit)
    if air.sum() < FEWEST:
        return None
    force = trace.force - float(np.median(trace.force[air]))
    within = np.arange(len(trace))
    halves = []
    for low, high in ((begin, 0.5 * (begin + deep)), (0.5 * (begin + deep), deep)):
        there = (trace.depth > low) & (trace.depth < high)
        going, coming = force[there & (within < end)], force[there & (within >= end) & (within < last)]
        if 2 * min(len(going), len(coming)) < FEWEST or not np.mean(going) > 0:
            return None
        halves.append((float(np.mean(going)), float(-np.mean(coming))))
    ratios = [out / inside for inside, out in halves]
    if abs(ratios[0] - ratios[1]) > 0.5 * max(abs(ratios[0] - 1), abs(ratios[1] - 1), UNEVEN):
        return None  # it grows with the depth, as where the next wall resists on the way in
    going_in, coming_out = np.mean(halves, axis=0)
    return Ways(float(coming_out / going_in), float(going_in - coming_out))


def way_out(ratio: float) -> tuple[str, str]:
    """The name of an asymmetric way out, and a sentence with what could make it and what would tell."""
    words = f"The way out is asymmetric: it resists {max(ratio, 0.0):.2g} times as much as the way in, and K06 has 1"
    if ratio > 1:
        return "barbs", (
            f"{words}. Barbs, a bent or rough tip, or tissue that closes behind it do this. To tell: withdraw a smooth "
            "needle of the same diameter"
        )
    return "asymmetric_way_out", (
        f"{words}. A hole that stays open, a cutting force or a wetted shaft do this. To tell: go in and out a second "
        "time at the same place"
    )

"""What a trace shows of each layer, as the start of a fit."""

from __future__ import annotations

import numpy as np

from punctura.rivals.problem import Wall
from punctura.rivals.starts import Seen
from punctura.trace import Segments, Trace, TraceError


def walls_of(trace: Trace, segments: Segments, one: bool = False) -> tuple[Wall, ...]:
    """A wall for each pop of the first insertion, or one wall. Raises TraceError without an insertion."""
    inward = [stroke for stroke in segments.strokes if stroke.kind == "in" and stroke.insertion == 0]
    if not inward:
        raise TraceError(f"{trace.source}: the needle never goes in: rivals need an insertion")
    end = inward[-1].end - 1
    contact = segments.contact if segments.contact is not None else inward[0].start
    pops = [pop for pop in segments.pops if pop.start <= end]
    slope = _slope(trace, pops[-1].end if pops else contact, end)
    if one or not pops:
        surface, deepest = float(trace.depth[contact]), float(trace.depth[end])
        peak = pops[0].force if pops else float(trace.force[contact : end + 1].max())
        reach = max((pops[0].depth if pops else deepest) - surface, 1e-5)
        after = float(trace.force[pops[0].end]) if pops else peak
        seen = Seen(reach, max(peak, 1e-6), max(after, 1e-6), slope)
        punctured = pops[0].start + 1 if pops and one else None
        return (Wall(seen, surface, surface - 0.3 * reach, surface + 0.5 * reach, punctured),)
    walls: list[Wall] = []
    below = 0.0  # force of the walls before this one, N
    for i, pop in enumerate(pops):
        surface = float(trace.depth[contact if i == 0 else pops[i - 1].end])
        reach = max(pop.depth - surface, 1e-5)
        left = float(trace.force[pop.end])
        seen = Seen(reach, max(pop.force - below, 1e-6), max(left - below, 1e-6), slope)
        lowest = surface - 0.3 * reach if i == 0 else float(trace.depth[pops[i - 1].start])
        walls.append(Wall(seen, surface, lowest, surface + 0.7 * reach, pop.start + 1))
        below = left
    return tuple(walls)


def _slope(trace: Trace, start: int, end: int) -> float:
    """Slope of the force while the needle goes in behind the last pop, N/m; never less than 0."""
    depth, force = trace.depth[start : end + 1], trace.force[start : end + 1]
    if len(depth) < 5 or np.ptp(depth) < 1e-5:
        return 0.0
    return max(0.0, float(np.polyfit(depth, force, 1)[0]))

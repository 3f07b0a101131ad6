"""What a trace shows of each layer, and from it the first values for a fit of a rival."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from punctura.trace import Segments, Trace, TraceError


@dataclass(frozen=True)
class Seen:
    """What a trace shows of a layer. SI."""

    reach: float  # from the surface to the pop, m
    peak: float  # force of this layer before the pop, N
    after: float  # force of this layer after the pop, N
    slope: float  # of the force behind the last pop, N/m


@dataclass(frozen=True)
class Wall:
    """A layer as a trace shows it, before any fit. SI."""

    seen: Seen
    surface: float
    lowest: float  # bounds of the surface
    highest: float
    punctured: int | None  # first sample behind the puncture; None if the trace shows no puncture


Start = dict[str, float]


def _behind(seen: Seen) -> Start:
    return {"friction": seen.after, "friction_slope": seen.slope}


def _okamura(seen: Seen) -> Start:
    slope = max(seen.slope, 0.5 * seen.after / seen.reach)
    return {
        "linear": 0.5 * seen.peak / seen.reach,
        "quadratic": 0.5 * seen.peak / seen.reach**2,
        "cutting": 0.5 * seen.after,
        "friction_slope": slope,
    }


def _rise(seen: Seen) -> Start:
    growth = 3 / seen.reach
    return {"growth": growth, "scale": seen.peak / 19.0} | _behind(seen)  # e^3 - 1 = 19


def _gordon(seen: Seen) -> Start:
    return _rise(seen) | {"fall": 0.1 * seen.reach}


def _hunt_crossley(seen: Seen) -> Start:
    return {"peak": seen.peak, "exponent": 1.8} | _behind(seen)


def _kelvin_voigt(seen: Seen) -> Start:
    return {"stiffness": 0.7 * seen.peak / seen.reach} | _behind(seen)


def _mahvash_dupont(seen: Seen) -> Start:
    exponent = 1.8
    return {"at_1_mm": seen.peak * (1e-3 / seen.reach) ** exponent, "exponent": exponent} | _behind(seen)


def _dahl(seen: Seen) -> Start:
    return {"stiffness": seen.peak / seen.reach, "friction": max(seen.after, 1e-3), "friction_slope": seen.slope}


def _stick_slip(seen: Seen) -> Start:
    return {"stiffness": seen.peak / seen.reach, "friction": seen.peak, "friction_slope": seen.slope}


def _sign_of_velocity(seen: Seen) -> Start:
    return _behind(seen)


STARTS: dict[str, Callable[[Seen], Start]] = {
    "okamura": _okamura,
    "gordon": _gordon,
    "exponential": _rise,
    "hunt_crossley": _hunt_crossley,
    "kelvin_voigt": _kelvin_voigt,
    "mahvash_dupont": _mahvash_dupont,
    "dahl": _dahl,
    "stick_slip": _stick_slip,
    "sign_of_velocity": _sign_of_velocity,
}


def walls_of(trace: Trace, segments: Segments, one: bool = False) -> tuple[Wall, ...]:
    """A wall for each pop of the first insertion, or one wall. Raises TraceError without an insertion."""
    inward = [stroke for stroke in segments.strokes if stroke.kind == "in" and stroke.insertion == 0]
    if not inward:
        raise TraceError(f"{trace.source}: the needle never goes in: rivals need an insertion")
    end = max((stroke.end - 1 for stroke in inward), key=lambda i: trace.depth[i])
    contact = segments.contact
    if contact is None or contact > end:  # in a later insertion
        contact = inward[0].start
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

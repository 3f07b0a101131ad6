"""Intervals for a needle, a lag or a delay stated with a tolerance: the fit is repeated at both ends of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from punctura import Needle
from punctura.identify.causes import Cause
from punctura.identify.fit import Fit, Misfit, fit
from punctura.identify.intervals import Estimate
from punctura.identify.parameters import Free, Parameters
from punctura.identify.rig import Rig

Array = NDArray[np.float64]


def with_tolerance(found: Sequence[Estimate], of: Fit, rig: Rig) -> tuple[Estimate, ...]:
    """The estimates of a fit, with the intervals that the tolerances of needle and sensor leave.

    A tolerance is taken for the 95 % interval of the true value. Its part of an interval is how far the best value
    moves from one end of the tolerance to the other, and adds to the rest by squares. Where no fit succeeds there, no
    bound is known.
    """
    p = of.parameters
    bases = [("", [replace(p, needle=needle) for needle in ends]) for ends in _ends(p.needle, rig)]
    bases += [(name, [p.with_values({name: end}) for end in ends]) for name, ends in _late_ends(rig)]
    for held, ends in bases:  # the delay of a filter that is not known may be free, too
        moved = [_values_with(base, of, held) for base in ends]
        found = [_widened(one, of.free, j, [each[j] for each in moved]) for j, one in enumerate(found)]
    return tuple(found)


def doubt_of_needle(found: Sequence[Estimate], needle: Needle, rig: Rig) -> tuple[Cause, ...]:
    """One cause, if the tip length that fits is not that of any needle within the tolerances."""
    diameters, angles = (
        [value, value - tolerance, value + tolerance]
        for value, tolerance in (
            (needle.diameter, rig.diameter_tolerance),
            (needle.tip_angle, rig.tip_angle_tolerance),
        )
    )
    tips = [diameter / np.tan(angle) for diameter, angle in product(diameters, angles)]
    one = next((one for one in found if one.name == "tissue.tip_length"), None)
    if one is None or one.low is None or one.high is None:
        return ()
    if max(tips) < one.low or min(tips) > one.high:
        text = (
            f"A tip length of {one.value * 1e3:.3g} mm [{one.low * 1e3:.3g}, {one.high * 1e3:.3g}] fits, and that of "
            f"the stated needle is {tips[0] * 1e3:.3g} mm. If its diameter or its angle is stated wrongly, the "
            "intervals do not hold: measure them, or state a tolerance (--needle diameter_mm=1.27+-0.03)"
        )
        return (Cause("needle", 0.0, text),)
    return ()


def _ends(needle: Needle, rig: Rig) -> Iterator[tuple[Needle, Needle]]:
    d, angle = needle.diameter, needle.tip_angle
    if rig.diameter_tolerance:
        yield Needle(d - rig.diameter_tolerance, angle), Needle(d + rig.diameter_tolerance, angle)
    if rig.tip_angle_tolerance:
        yield Needle(d, angle - rig.tip_angle_tolerance), Needle(d, angle + rig.tip_angle_tolerance)


def _late_ends(rig: Rig) -> Iterator[tuple[str, tuple[float, float]]]:
    """Lag and delay, s, and play, m, at both ends of their tolerances."""
    for name, value in rig.late.items():
        if tolerance := getattr(rig, f"{name}_tolerance"):
            low = value - tolerance
            yield name, (low if name == "delay" else max(low, 0.0), value + tolerance)


def _values_with(base: Parameters, of: Fit, held: str) -> Array:
    """The best values (p,) where what is not free, and `held`, is as in `base`; NaN where no fit succeeds. It begins
    with the pops where they are.
    """
    old = of.misfit
    kept = [j for j, name in enumerate(of.free.names) if name != held]
    names = [of.free.names[j] for j in kept]
    try:
        start = old.free(names, base).parameters(of.u[kept])
        misfit = Misfit(old.trace, start, old.used, old.zero, old.depth_error, old.whitening)
        end = fit(misfit, names, start).parameters
    except ValueError:  # TraceError; or a friction that jams this needle
        return np.full(len(of.u), np.nan)
    return np.array([end.get(name) for name in of.free.names])


def _widened(one: Estimate, free: Free, j: int, moved: Sequence[float]) -> Estimate:
    if not np.isfinite(moved).all():
        return replace(one, low=None, high=None)
    logarithmic = free.logarithmic(j)
    to: Callable[[float], float] = np.log if logarithmic else float
    back: Callable[[float], float] = np.exp if logarithmic else float
    value, ends = to(one.value), [to(v) for v in moved]
    low, high = one.low, one.high  # each widens also where the other is not known
    if low is not None:
        wide = float(back(value - np.hypot(value - to(low), max(value - min(ends), 0.0))))
        low = max(wide, float(free.low[j])) if low >= 0 and not logarithmic else wide
    if high is not None:
        high = float(back(value + np.hypot(to(high) - value, max(max(ends) - value, 0.0))))
    return replace(one, low=low, high=high)

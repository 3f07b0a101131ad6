"""First values for a fit of a rival, from what a trace shows of a layer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Seen:
    """What a trace shows of a layer. SI."""

    reach: float  # from the surface to the pop, m
    peak: float  # force of this layer before the pop, N
    after: float  # force of this layer after the pop, N
    slope: float  # of the force behind the last pop, N/m


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

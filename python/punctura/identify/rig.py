"""What is known of the rig that made a trace: stated, or estimated from the trace."""

from __future__ import annotations

import math
from dataclasses import dataclass

from punctura import Needle
from punctura.errors import ConfigurationError, Problem


@dataclass(frozen=True)
class Rig:
    """What is stated of a rig, SI. None: it is estimated from the trace."""

    depth_noise: float | None = None  # m, standard deviation from sample to sample; 0: the depth is exact
    diameter_tolerance: float = 0.0  # m, of the stated needle: the true one is within it, in 95 of 100
    tip_angle_tolerance: float = 0.0  # rad


UNKNOWN = Rig()


def check(rig: Rig, needle: Needle) -> None:
    """Raises ConfigurationError with all that is wrong with a rig that has this needle."""
    size, angle = needle.diameter, needle.tip_angle
    bounds = {
        "depth_noise": (math.inf, "a number of m, 0 or more"),
        "diameter_tolerance": (size, f"0 or more, and less than the diameter, {size:.4g} m"),
        "tip_angle_tolerance": (
            min(angle, math.pi / 2 - angle),
            f"0 or more, and leave the tip angle, {angle:.4g} rad, between 0 and pi/2",
        ),
    }
    values = {name: getattr(rig, name) for name in bounds}
    problems = [
        Problem(f"rig.{name}", values[name], f"must be {words}")
        for name, (most, words) in bounds.items()
        if values[name] is not None and not 0 <= values[name] < most
    ]
    if problems:
        raise ConfigurationError(problems)


@dataclass(frozen=True)
class RigValue:
    """An error of the rig that the identification takes into account, SI."""

    name: str
    value: float
    unit: str
    stated: bool  # False: estimated from the trace

    def __str__(self) -> str:
        origin = "stated" if self.stated else "estimated from the trace"
        return f"{self.name} {self.value:.3g} {self.unit}, {origin}"

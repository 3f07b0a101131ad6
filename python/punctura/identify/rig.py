"""What is known of the rig that made a trace: stated, or estimated from the trace."""

from __future__ import annotations

import math
from dataclasses import dataclass

from punctura import Needle
from punctura.errors import ConfigurationError, Problem
from punctura.identify.parameters import LATE, LATEST


@dataclass(frozen=True)
class Rig:
    """What is stated of a rig, SI. None: it is estimated from the trace."""

    depth_noise: float | None = None  # m, standard deviation from sample to sample; 0: the depth is exact
    diameter_tolerance: float = 0.0  # m, of the stated needle: the true one is within it, in 95 of 100
    tip_angle_tolerance: float = 0.0  # rad
    lag: float | None = None  # s, time constant of the force sensor's filter
    delay: float | None = None  # s, of the force behind the depth; negative if the depth is late
    play: float | None = None  # m, by which the needle stays behind where the drive turns
    slack: float | None = None  # m, by which it slips where the force on it changes the sign
    lag_tolerance: float = 0.0  # s
    delay_tolerance: float = 0.0  # s
    play_tolerance: float = 0.0  # m
    slack_tolerance: float = 0.0  # m

    @property
    def late(self) -> dict[str, float]:
        """What is stated of the parameters `lag` and `delay`, s, and `play` and `slack`, m."""
        return {name: value for name in LATE if (value := getattr(self, name)) is not None}

    def values(self) -> tuple[RigValue, ...]:
        """Each stated number that is not 0, without the noise of the depth, which may not matter."""
        every = {**self.late, **{f"{name}_tolerance": getattr(self, f"{name}_tolerance") for name in _UNITS}}
        return tuple(RigValue(name, value, _UNITS[name.removesuffix("_tolerance")], True)
                     for name, value in every.items() if value)  # fmt: skip


_UNITS = {"lag": "s", "delay": "s", "play": "m", "slack": "m", "diameter": "m", "tip_angle": "rad"}
UNKNOWN = Rig()


def check(rig: Rig, needle: Needle) -> None:
    """Raises ConfigurationError with all that is wrong with a rig that has this needle."""
    size, angle = needle.diameter, needle.tip_angle
    most = {name: f"less than {LATEST[name]:g} {_UNITS[name]}" for name in LATE}
    beside = {name: LATEST[name] if name in rig.late else math.ulp(0.0) for name in LATE}  # a tolerance needs a value
    bounds = {
        "depth_noise": (0.0, math.inf, "a number of m, 0 or more"),
        **{name: (0.0, LATEST[name], f"0 or more, and {most[name]}") for name in ("lag", "play", "slack")},
        "delay": (-LATEST["delay"], LATEST["delay"], f"{most['delay']}, also if it is negative"),
        **{
            f"{name}_tolerance": (0.0, beside[name], f"0 without a {name}; else 0 or more, and {most[name]}")
            for name in LATE
        },
        "diameter_tolerance": (0.0, size, f"0 or more, and less than the diameter, {size:.4g} m"),
        "tip_angle_tolerance": (
            0.0,
            min(angle, math.pi / 2 - angle),
            f"0 or more, and leave the tip angle, {angle:.4g} rad, between 0 and pi/2",
        ),
    }
    values = {name: getattr(rig, name) for name in bounds}
    problems = [
        Problem(f"rig.{name}", values[name], f"must be {words}")
        for name, (low, high, words) in bounds.items()
        if values[name] is not None and not low <= values[name] < high
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

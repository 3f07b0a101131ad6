"""What is known of the rig that made a trace: stated, or estimated from the trace."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Rig:
    """What is stated of a rig, SI. None: it is estimated from the trace."""

    depth_noise: float | None = None  # m, standard deviation from sample to sample; 0: the depth is exact
    diameter_tolerance: float = 0.0  # m, of the stated needle: the true one is within it, in 95 of 100
    tip_angle_tolerance: float = 0.0  # rad


UNKNOWN = Rig()


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

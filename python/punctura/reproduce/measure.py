"""Characteristic numbers of a run, and their values by the law."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from punctura import Membrane, Needle, Phase, ThickLaw, Ticks
from punctura.reproduce.operator import Floats


@dataclass(frozen=True)
class Landmarks:
    """Characteristic numbers of a pass through one membrane. Resistance is positive against insertion."""

    peak: float  # N
    pop_depth: float  # m, depth of the tip in the membrane at the peak
    plateau: float  # N, with the shaft through the membrane
    withdrawal: float  # N, largest resistance against withdrawal

    @property
    def drop(self) -> float:
        """Decrease of the resistance at the pop, N."""
        return self.peak - self.plateau


def of_law(needle: Needle, membrane: Membrane) -> Landmarks:
    """The landmarks of K06 (18), (19) for a perpendicular needle."""
    law = ThickLaw(needle, membrane)
    depth = np.linspace(0.0, law.X + law.U, 200_001)
    lower, _ = law.bounds(depth)
    through_lower, through_upper = law.bounds(2 * (law.X + law.U))
    at = int(np.argmin(lower))
    return Landmarks(float(-lower[at]), float(depth[at]), float(-through_lower), float(through_upper))


def of_trace(trace: Ticks, membrane: int, needle: Needle, properties: Membrane) -> Landmarks:
    """The landmarks of a run for one membrane. The plateau is the median over ticks that slide in on the shaft."""
    law = ThickLaw(needle, properties)
    resistance: Floats = -trace.axial_force[:, membrane]
    depth: Floats = trace.depth[:, membrane]
    on_shaft = (depth > law.X + law.U) & (trace.phase[:, membrane] == int(Phase.sliding_in))
    at = int(np.argmax(resistance))
    return Landmarks(
        float(resistance[at]), float(depth[at]), float(np.median(resistance[on_shaft])), float(-np.min(resistance))
    )


def alternations(force: Floats, smallest: float = 1e-6) -> int:
    """Number of ticks at which the force step (N) changes its sign. Both steps must be larger than `smallest`."""
    step = np.diff(force)
    turned = (step[1:] * step[:-1] < 0) & (np.minimum(np.abs(step[1:]), np.abs(step[:-1])) > smallest)
    return int(np.count_nonzero(turned))

"""How often the force turns back while a needle enters: the data behind the close-up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from punctura import Phase, ThickLaw
from punctura.reproduce.measure import alternations
from punctura.reproduce.operator import Floats, steady
from punctura.reproduce.scenes import COUPLING, NEEDLE, Solver, k06_membrane, one_membrane

SPEED = 5e-3  # m/s
THIN = 0.1e-3  # m, the membrane of Fig. 10
SWEEP_MM = tuple(round(float(h), 4) for h in np.geomspace(0.02, 4.0, 47))
SOLVERS: tuple[Solver, Solver] = ("exact", "paper")


@dataclass(frozen=True)
class SteadyEntry:
    """A needle that goes in at a constant speed and an ideal sensor, through filter and model."""

    time: Floats  # s, from the tick of first contact on
    p_y: Floats  # m
    force: Floats  # f_y, N
    ticks_in_entry: int  # until the near part of the tip has crossed the membrane: q = H
    pop: tuple[float, float]  # N, before and after

    @property
    def turns(self) -> int:
        """Alternations from contact to the end of the way in."""
        return alternations(self.force)


def steady_entry(thickness: float, solver: Solver, speed: float = SPEED) -> SteadyEntry:
    """The way in, well past the pop."""
    law = ThickLaw(NEEDLE, k06_membrane(thickness))
    deepest = law.X + law.U + 3e-3
    scene = one_membrane(thickness, solver)
    y, trace = steady(scene, deepest, speed)
    inside = (trace.phase[:, 0] != int(Phase.outside)) & (np.arange(y.size) < y.size // 2)
    contact = int(np.argmax(inside))
    way_in = slice(contact, y.size // 2)
    depth, force = trace.depth[way_in, 0], trace.force[way_in, 1]
    largest_drop = int(np.argmin(np.diff(force)))
    return SteadyEntry(
        np.arange(force.size) / scene.servo.rate,
        y[way_in],
        force,
        int(np.argmax(depth > law.U)),
        (float(force[largest_drop]), float(force[largest_drop + 1])),
    )


def period() -> float:
    """T of the scenes, s."""
    return 1 / one_membrane(THIN).servo.rate


def swing(paper: SteadyEntry, exact: SteadyEntry) -> float:
    """By how much the paper's force shakes about the exact one while it enters, from tick to tick: the median, N."""
    ticks = slice(0, exact.ticks_in_entry)
    return float(np.median(np.abs(np.diff(paper.force[ticks] - exact.force[ticks]))))


def onset() -> float:
    """The thickness (m) below which the substitution (31) does not settle at contact.

    An error that alternates in f comes back through (31) times |dPhi_I/dq| / g, and through the memory of the offset
    (25) times (1 + 2a) / (1 + a) of that, a = B/D. At contact |dPhi_I/dq| = A_I Q / H: the product is 1 at this H.
    """
    law = ThickLaw(NEEDLE, k06_membrane(THIN))
    d = COUPLING.stiffness * period() + COUPLING.damping
    g, a = d / period(), COUPLING.damping / d
    return float(law.A_I * law.Q / g * (1 + 2 * a) / (1 + a))

"""Counts the sign changes of the force slope during entry: the data of the close-up figure."""

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
    """An insertion at constant speed with an ideal sensor, through filter and model."""

    time: Floats  # s, from the tick of first contact
    p_y: Floats  # m
    force: Floats  # f_y, N
    ticks_in_entry: int  # ticks until the point of the tip reaches the far face: q = H
    pop: tuple[float, float]  # N, before and after

    @property
    def turns(self) -> int:
        """Number of alternations from contact to the end of the insertion."""
        return alternations(self.force)


def steady_entry(thickness: float, solver: Solver, speed: float = SPEED) -> SteadyEntry:
    """Simulates the insertion, well past the pop."""
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
    """Median tick-to-tick change of the difference between paper's and exact force during entry, N."""
    ticks = slice(0, exact.ticks_in_entry)
    return float(np.median(np.abs(np.diff(paper.force[ticks] - exact.force[ticks]))))


def onset() -> float:
    """The thickness (m) below which the substitution (31) does not converge at contact.

    An alternating error of f is multiplied per tick by |dPhi_I/dq| / g through (31), and by (1 + 2a) / (1 + a) through
    the offset (25), with a = B/D. At contact |dPhi_I/dq| = A_I Q / H. The total factor is 1 at this H.
    """
    law = ThickLaw(NEEDLE, k06_membrane(THIN))
    d = COUPLING.stiffness * period() + COUPLING.damping
    g, a = d / period(), COUPLING.damping / d
    return float(law.A_I * law.Q / g * (1 + 2 * a) / (1 + a))

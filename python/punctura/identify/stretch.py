"""Start values for several walls: each rise of the force before a pop is fitted alone, for given springs and grips."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from punctura import Needle
from punctura.identify.parameters import MEMBRANE, Parameters, default_coupling, default_membrane
from punctura.identify.start import friction_of_ratio
from punctura.trace import Pop, Segments, Trace

Array = NDArray[np.float64]

SAMPLES = 60  # of a stretch
THIN = 0.02  # of the tip: the thickness of a wall whose pop is sharp


@dataclass(frozen=True, eq=False)
class Stretch:
    """The rise before a pop: depth, m, measured force and the force that is the wall's own (n,), N."""

    pop: Pop
    depth: Array
    force: Array
    own: Array

    @property
    def peak(self) -> float:
        """The wall's own force at the pop, N."""
        return max(float(self.own[-1]), self.pop.drop)


def stretches(trace: Trace, segments: Segments) -> list[Stretch]:
    """One for each pop of the first insertion. A wall's own force is the part above the force behind the pop before."""
    begin, base = segments.contact or 0, 0.0
    found: list[Stretch] = []
    for pop in segments.pops:
        if trace.strokes[pop.start] != 0 or pop.start - begin < 4:
            continue
        picked = np.unique(np.linspace(begin, pop.start, SAMPLES).astype(int))
        force = trace.force[picked]
        found.append(Stretch(pop, trace.depth[picked], force, np.maximum(force - base, 0)))
        begin, base = pop.end, pop.force - pop.drop
    return found


def stretch_starts(trace: Trace, segments: Segments, needle: Needle, curved: bool) -> Iterator[Parameters]:
    """The best start values of each spring on a grid of springs; if `curved` of tip lengths and growths, too.

    A spring that is too soft to reach the peaks is left out.
    """
    parts = stretches(trace, segments)
    if len(parts) < sum(int(trace.strokes[pop.start] == 0) for pop in segments.pops):
        return  # a rise has too few samples
    ways = [float(part.depth[-1] - part.depth[0]) for part in parts]
    stiffest = max(part.peak / way for part, way in zip(parts, ways, strict=True))
    tip = needle.diameter / np.tan(needle.tip_angle)
    lengths = max(ways) * np.array([0.15, 0.25, 0.4, 0.6, 0.8, 1.0]) if curved else np.array([tip])
    bends = (-1.0, 0.0, 0.7, 1.5, 2.5, 4.0, 6.0) if curved else (0.0,)
    tried = []
    for stiffness in stiffest * np.array([1.1, 1.5, 2.0, 3.0, 5.0, 10.0, 100.0]):
        for length in lengths:
            for bend in bends:
                fits = [_grip(part, stiffness, length, bend) for part in parts]
                error = sum(part_error for part_error, _, _ in fits)
                tried.append((error, stiffness, length, bend, [(first, slope) for _, first, slope in fits]))
    tried.sort(key=lambda one: one[0])
    springs: list[float] = []
    for _, stiffness, length, bend, grips in tried:  # the best of each spring
        if stiffness not in springs:
            springs.append(stiffness)
            yield _parameters(parts, needle, stiffness, length, bend, grips, curved)


def _grip(part: Stretch, stiffness: float, length: float, bend: float) -> tuple[float, float, float]:
    """Squared error, N^2, first force and slope, N, that fit a rise of this bend best; none is negative."""
    proxy = part.depth - part.force / stiffness
    opening = 1 - (proxy[-1] - proxy) / length
    inside = opening > 0
    shapes = np.column_stack((inside, np.where(inside, _rise(np.clip(opening, 0, 2), bend), 0.0)))
    gram, aim = shapes.T @ shapes, shapes.T @ part.own
    best = (float(part.own @ part.own), 0.0, 0.0)
    determinant = gram[0, 0] * gram[1, 1] - gram[0, 1] ** 2
    trials = [(aim[0] / max(gram[0, 0], 1e-12), 0.0), (0.0, aim[1] / max(gram[1, 1], 1e-12))]
    if determinant > 1e-12:
        trials.append(
            ((gram[1, 1] * aim[0] - gram[0, 1] * aim[1]) / determinant,
             (gram[0, 0] * aim[1] - gram[0, 1] * aim[0]) / determinant)
        )  # fmt: skip
    for first, slope in trials:
        if first >= 0 and slope >= 0:
            left = part.own - shapes @ np.array([first, slope])
            best = min(best, (float(left @ left), float(first), float(slope)))
    return best


def _rise(opening: Array, bend: float) -> Array:
    """The exponential grip over its value at the opening 1, where it is 1."""
    return opening if bend == 0 else np.asarray(np.expm1(bend * opening) / np.expm1(bend))


def _parameters(
    parts: list[Stretch],
    needle: Needle,
    stiffness: float,
    length: float,
    bend: float,
    grips: list[tuple[float, float]],
    curved: bool,
) -> Parameters:
    rows, base = [], 0.0
    growth = bend / needle.diameter
    rise = needle.diameter if bend == 0 else np.expm1(bend) / growth
    for part, (first, slope) in zip(parts, grips, strict=True):
        peak = max(first + slope, 1e-3)
        left = part.pop.force - part.pop.drop
        plateau = float(np.clip(left - base, 0.02 * peak, 0.98 * peak))
        friction = friction_of_ratio(peak / plateau, needle.tip_angle)
        grip = plateau / (2 * friction)
        share = float(np.clip(first / peak, 0.0, 0.9))
        thickness = THIN * length
        surface = part.pop.depth - part.pop.force / stiffness - length - 0.5 * thickness
        row = default_membrane()
        named = {
            "surface": surface, "stiffness": grip * (1 - share) / rise, "precompression": grip * share,
            "friction": friction, "thickness": thickness, "growth": growth, "tip_length": length if curved else 0.0,
        }  # fmt: skip
        for name, value in named.items():
            row[MEMBRANE.index(name)] = value
        rows.append(row)
        base = left
    return Parameters(needle, np.array(rows), default_coupling(stiffness))

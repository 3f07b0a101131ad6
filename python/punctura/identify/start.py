"""Start values from the convex fit: profiles of the walls, linear in the knots' values, for given depths of contact."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from punctura import Needle, ProfileLaw
from punctura.identify.parameters import MEMBRANE, Parameters, default_coupling, default_membrane
from punctura.trace import Segments, Trace, TraceError
from punctura.trace.segment import way_to_tissue

Array = NDArray[np.float64]

KNOTS = 12  # a wall
FEWEST = 5  # samples of the first insertion
PLACES = (0.5, 0.3, 0.7, 0.9)  # of a wall without a pop, shares of the way
OTHER_SHARES = (0.5, 0.2, 0.05)  # of a grip, that are precompression
STIFFER = 5.0  # times the spring
SOFTEST, STIFFEST = 50.0, 2e5  # N/m, of a series spring, for a trace of the usual scale
LEAST, SHORTEST = 1e-3, 1e-4  # N, m: so much force before a pop, and so long a way, at least; for such a trace


@dataclass(frozen=True, eq=False)
class ProfileFit:
    """Walls as free profiles. knots: depths, m, one row a wall; values: -phi_I there, N; rmse: N."""

    surfaces: Array
    thickness: float
    stiffness: float
    knots: Array
    values: Array
    rmse: float


def first_insertion(trace: Trace, segments: Segments) -> Trace:
    """The samples of the first insertion up to its end, without holds and withdrawals. Raises TraceError."""
    going_in = way_to_tissue(trace, segments.strokes)
    if going_in is None:
        return trace
    if (few := going_in.end - going_in.start) < FEWEST:
        doubts = "".join(f"; {finding}" for finding in trace.findings if finding.kind == "depth_doubtful")
        raise TraceError(
            f"{trace.source or 'the trace'}: the needle goes in within {few} samples, from sample "
            f"{going_in.start + 1} on, and a fit needs at least {FEWEST}{doubts}"
        )
    return trace[going_in.start : going_in.end]


def profile_fit(trace: Trace, surfaces: Array, lengths: Array, thickness: float, stiffness: float) -> ProfileFit:
    """Fits the knots' values of every wall at once: bounded linear least squares, one optimum, no start values.

    trace: one insertion. surfaces, lengths: of each wall and its profile, m. stiffness: of the series spring, N/m.
    """
    from scipy.optimize import nnls

    at = trace.depth - np.maximum(trace.force, 0) / stiffness  # the proxy, while the needle slides in
    knots = np.array([length * np.linspace(0, 1, KNOTS) for length in lengths])
    zeros = np.zeros(KNOTS)
    with warnings.catch_warnings():  # the trace has told what is unusual in it
        warnings.simplefilter("ignore", UserWarning)
        laws = [ProfileLaw(row.tolist(), zeros, zeros, thickness) for row in knots]
    weights = np.hstack([law.weights(at - surface) for law, surface in zip(laws, surfaces, strict=True)])
    values, norm = nnls(weights, np.asarray(trace.force))
    return ProfileFit(
        surfaces, thickness, stiffness, knots, values.reshape(knots.shape), float(norm / np.sqrt(len(trace)))
    )


def starts(
    trace: Trace, segments: Segments, needle: Needle, membranes: int, curved: bool = False
) -> Iterator[Parameters]:
    """Start values, the most promising first: from the best profile fits over contact depths and springs.

    curved: with growth and tip length.
    """
    found = sorted(_search(trace, segments, needle, membranes), key=lambda fit: fit.rmse)
    for fit in found:
        yield _physical(fit, needle, curved, LEAST * trace.scale[0])


def _search(trace: Trace, segments: Segments, needle: Needle, membranes: int) -> Iterator[ProfileFit]:
    """Profile fits for several springs and tip lengths. They give the surfaces: a wall pops when the tip is through."""
    insertion = first_insertion(trace, segments)
    insertion = insertion[:: max(1, len(insertion) // 400)]
    contact = float(trace.depth[segments.contact] if segments.contact is not None else insertion.depth[0])
    for share in PLACES if _seen_pops(trace, segments) < membranes else PLACES[:1]:
        yield from _around(insertion, contact, *_pops(insertion, trace, segments, contact, membranes, share), needle)


def _around(insertion: Trace, contact: float, ends: Array, own: Array, needle: Needle) -> Iterator[ProfileFit]:
    tip = needle.diameter / np.tan(needle.tip_angle)
    of_force, of_depth = insertion.scale
    unit = of_force / of_depth
    least, most = SOFTEST * min(unit, 1.0), STIFFEST * max(unit, 1.0)
    way = max(float(ends[0]) - contact, SHORTEST * of_depth)
    left = way - tip  # of the way from contact to the pop: the spring gives
    soft = own[0] / left if left > 0.02 * way else np.inf
    springs = {max(least, min(share * own[0] / way, most)) for share in (1.3, 2.0, 4.0, 20.0, 200.0)}
    for stiffness in sorted(springs | ({max(soft, least)} if np.isfinite(soft) else set())):
        for length in (tip, max(way - own[0] / stiffness, 0.1 * way)):
            for thickness in (0.1 * length, 0.5 * length):
                surfaces = ends - own / stiffness - length - 0.5 * thickness
                lengths = np.full(len(ends), 1.3 * length + thickness)
                yield profile_fit(insertion, surfaces, lengths, thickness, stiffness)


def _seen_pops(trace: Trace, segments: Segments) -> int:
    return sum(int(trace.strokes[pop.start] == 0) for pop in segments.pops)


def _pops(
    insertion: Trace, trace: Trace, segments: Segments, contact: float, membranes: int, share: float
) -> tuple[Array, Array]:
    """The depth where each wall gives way, m, and its own force there, N: at the greatest pops.

    A wall without a pop gives way at this share of the longest way without one.
    """
    first = [pop for pop in segments.pops if trace.strokes[pop.start] == 0]
    greatest = sorted(sorted(first, key=lambda pop: -pop.drop)[:membranes], key=lambda pop: pop.depth)
    ends = [pop.depth for pop in greatest]
    own = [pop.force for pop in greatest]
    for i in range(1, len(greatest)):
        own[i] = max(greatest[i].force - (greatest[i - 1].force - greatest[i - 1].drop), greatest[i].drop)
    deepest = float(insertion.depth.max())
    while len(ends) < membranes:
        edges = [contact, *ends, deepest]
        widest = int(np.argmax(np.diff(edges)))
        ends.insert(widest, edges[widest] + share * (edges[widest + 1] - edges[widest]))
        own.insert(widest, float(insertion.force.max()) / membranes)
    return np.array(ends), np.maximum(own, LEAST * trace.scale[0])


def _physical(fit: ProfileFit, needle: Needle, curved: bool, least: float) -> Parameters:
    """Stiffness, precompression and friction that have the shape of each profile; with `curved` growth and tip, too.

    least: N, of the greatest force of a wall.
    """
    rows = []
    for surface, knots, values in zip(fit.surfaces, fit.knots, fit.values, strict=True):
        peak = max(float(values.max()), least)
        plateau = float(np.clip(values[-1], 0.02 * peak, 0.98 * peak))
        friction = friction_of_ratio(peak / plateau, needle.tip_angle)
        grip = plateau / (2 * friction)
        length = max(float(knots[int(np.argmax(values))]), 2 * float(knots[1]))
        opening = needle.diameter * knots / length
        first, growth = (
            grip_shape(opening[knots <= length], values[knots <= length]) if curved else (values[0] / peak, 0)
        )
        precompression = grip * float(np.clip(first, 0.02, 0.9))
        rise = needle.diameter if growth == 0 else np.expm1(growth * needle.diameter) / growth
        named = {
            "surface": surface, "stiffness": (grip - precompression) / rise, "precompression": precompression,
            "friction": friction, "thickness": fit.thickness,
        } | ({"growth": growth, "tip_length": length} if curved else {})  # fmt: skip
        row = default_membrane()
        for name, value in named.items():
            row[MEMBRANE.index(name)] = value
        rows.append(row)
    return Parameters(needle, np.array(rows), default_coupling(fit.stiffness))


def other_grips(parameters: Parameters) -> Iterator[Parameters]:
    """The walls with the same grip on the full needle, but with other shares of it as precompression; then the same
    behind a stiffer spring.

    A trace that ends in the rise can be explained almost without precompression, and by much of it; by a soft spring,
    and by a soft wall. These optima are apart: no way leads from one to the other along which the misfit falls.
    """
    diameter = parameters.needle.diameter
    spring = parameters.get("coupling_stiffness")
    for stiffness, share in product((spring, STIFFER * spring), OTHER_SHARES):
        values = {"coupling_stiffness": stiffness}
        for wall in (f"membrane[{i}]" for i in range(len(parameters.membranes))):
            grip = parameters.get(f"{wall}.precompression") + parameters.get(f"{wall}.stiffness") * diameter
            values |= {f"{wall}.precompression": share * grip, f"{wall}.stiffness": (1 - share) * grip / diameter}
        yield parameters.with_values(values)


def grip_shape(opening: Array, force: Array) -> tuple[float, float]:
    """The first force over the last one, and the growth (1/m), of the exponential that fits best."""
    best = (np.inf, 0.0, 0.0)
    for growth in np.linspace(-2, 6, 33) / float(opening[-1]):
        rise = opening if growth == 0 else np.expm1(growth * opening) / growth
        shapes = np.column_stack((np.ones_like(rise), rise))
        first, slope = np.maximum(np.linalg.lstsq(shapes, force, rcond=None)[0], 0)
        error = float(np.sum((first + slope * rise - force) ** 2))
        last = first + slope * rise[-1]
        if error < best[0] and last > 0:
            best = (error, float(first / last), float(growth))
    return best[1], best[2]


def friction_of_ratio(ratio: float, tip_angle: float) -> float:
    """mu with which the peak of the thin law is `ratio` times its plateau, K06 (15); else the nearest."""
    mu = np.geomspace(1e-3, 0.9 / np.tan(tip_angle), 400)
    ratios = (mu + np.tan(tip_angle + np.arctan(mu))) / (2 * mu)
    mu, ratios = mu[: int(np.argmin(ratios)) + 1], ratios[: int(np.argmin(ratios)) + 1]
    return float(np.interp(-ratio, -ratios, mu))

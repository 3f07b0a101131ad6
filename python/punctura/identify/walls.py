"""Start values for several walls: by a convex problem, and for one membrane fewer or more than a fit has."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from punctura import Needle
from punctura._core import TraceModel
from punctura.identify.fit import Fit
from punctura.identify.parameters import MEMBRANE, Parameters, default_coupling, default_membrane
from punctura.identify.start import LEAST, friction_of_ratio
from punctura.trace import Segments, Trace

Array = NDArray[np.float64]

SAMPLES = 400  # of the first insertion
BENDS = (0.0, 0.7, 1.5, 2.5, 3.5, 5.0, 7.0)  # growth times diameter
LENGTHS = (0.15, 0.25, 0.4, 0.6, 0.75, 0.9, 1.1)  # tip lengths over the longest way from pop to pop
SPRINGS = (1.2, 2.0, 4.0, 12.0, 100.0)  # stiffness over that of the steepest rise
THIN = 0.02  # of the tip: the thickness of a wall whose pop is sharp


@dataclass(frozen=True, eq=False)
class _Shape:
    """The walls that fit best for a spring, N/m, a tip length, m, and a bend. walls (m, 3): a_i, b_i and p_i, N."""

    error: float
    stiffness: float
    length: float
    bend: float
    walls: Array


def rise_starts(trace: Trace, segments: Segments, needle: Needle, membranes: int, curved: bool) -> Iterator[Parameters]:
    """The best start values of each spring; if `curved`, over tip lengths and growths, too. None without enough pops.

    A wall's force before its pop at the depth z_i is a_i + b_i r(z), with the rise r of the grip over one tip length,
    and behind it p_i. For given rise and spring the a_i, b_i and p_i are the solution of a linear least-squares problem
    with bounds, all of them at once, so walls may overlap. Samples within a pop do not count.
    """
    from scipy.optimize import nnls

    pops = [pop for pop in segments.pops if trace.strokes[pop.start] == 0]
    pops = sorted(sorted(pops, key=lambda pop: -pop.drop)[:membranes], key=lambda pop: pop.start)
    end = next((stroke.end for stroke in segments.strokes if stroke.kind == "in"), len(trace))
    if len(pops) < membranes or end < 20:
        return
    counts = np.ones(end, bool)
    for pop in pops:
        counts[pop.start + 1 : pop.end] = False
    rows = np.flatnonzero(counts)[:: max(1, end // SAMPLES)]
    depth, force = trace.depth[rows], trace.force[rows]
    places = np.array([trace.depth[pop.start : pop.end + 1].mean() for pop in pops])
    begins = np.array([trace.depth[segments.contact or 0], *places[:-1]])
    base = np.array([0.0, *(pop.force - pop.drop for pop in pops[:-1])])
    peaks = np.array([pop.force for pop in pops]) - base
    ways = np.maximum(places - begins, 1e-5 * trace.scale[1])
    tip = needle.diameter / np.tan(needle.tip_angle)
    found = []
    for stiffness in float((peaks / ways).max()) * np.array(SPRINGS):
        proxy = depth - np.clip(force - base[:, None], 0, peaks[:, None]) / stiffness  # (m, n)
        last = places - peaks / stiffness
        for length in float(ways.max()) * np.array(LENGTHS) if curved else (tip,):
            for bend in BENDS if curved else (0.0,):
                shapes = _shapes(proxy, last, depth, places, length, bend)
                values, error = nnls(shapes, force)
                found.append(_Shape(error, stiffness, length, bend, values.reshape(3, -1).T))
    springs: list[float] = []
    for shape in sorted(found, key=lambda one: one.error):  # the best of each spring
        if shape.stiffness not in springs:
            springs.append(shape.stiffness)
            yield _parameters(shape, places, needle, curved, LEAST * trace.scale[0])


def _shapes(proxy: Array, last: Array, depth: Array, places: Array, length: float, bend: float) -> Array:
    """The columns (n, 3 m) of first forces, rises and plateaus."""
    gone = (proxy - (last[:, None] - length)) / length  # of the tip: 0 at contact, 1 at the pop
    before = depth <= places[:, None]
    inside = (before & (gone > 0)).astype(float)
    return np.vstack((inside, inside * _rise(np.clip(gone, 0, 1), bend), (~before).astype(float))).T


def _rise(opening: Array, bend: float) -> Array:
    """The exponential grip over its value at the opening 1, where it is 1."""
    return opening if bend == 0 else np.asarray(np.expm1(bend * opening) / np.expm1(bend))


def _parameters(shape: _Shape, places: Array, needle: Needle, curved: bool, least: float) -> Parameters:
    rows = []
    growth = shape.bend / needle.diameter
    rise = needle.diameter if shape.bend == 0 else np.expm1(shape.bend) / growth
    for place, (first, more, behind) in zip(places, shape.walls, strict=True):
        peak = max(first + more, least)
        plateau = float(np.clip(behind, 0.02 * peak, 0.98 * peak))
        friction = friction_of_ratio(peak / plateau, needle.tip_angle)
        grip = plateau / (2 * friction)
        share = float(np.clip(first / peak, 0.01, 0.9))
        thickness = THIN * shape.length
        surface = place - peak / shape.stiffness - shape.length - 0.5 * thickness
        row = default_membrane()
        named = {
            "surface": surface, "stiffness": grip * (1 - share) / rise, "precompression": grip * share,
            "friction": friction, "thickness": thickness, "growth": growth,
            "tip_length": shape.length if curved else 0.0,
        }  # fmt: skip
        for name, value in named.items():
            row[MEMBRANE.index(name)] = value
        rows.append(row)
    return Parameters(needle, np.array(rows), default_coupling(shape.stiffness))


PLACES = 24  # where one more wall is tried
KEPT = 3  # of them


def without_a_wall(fit: Fit, segments: Segments) -> Iterator[Parameters]:
    """The parameters without the deepest wall, if the needle never came to it; otherwise without the wall of the
    smallest pop, and without the wall that resists least.
    """
    parameters = fit.parameters
    surfaces = parameters.membranes[:, MEMBRANE.index("surface")]
    if surfaces.max() > fit.misfit.trace.depth.max():
        yield replace(parameters, membranes=np.delete(parameters.membranes, int(np.argmax(surfaces)), axis=0))
        return
    pops = TraceModel.pop_depths(parameters.needle, parameters.membranes, parameters.coupling)[0]
    depths = surfaces + pops
    left_out = {int(np.argmin(_grips(parameters)))}
    if segments.pops:
        smallest = min(segments.pops, key=lambda pop: pop.drop)
        left_out.add(int(np.argmin(np.abs(depths - smallest.depth))))
    for i in left_out:
        yield replace(parameters, membranes=np.delete(parameters.membranes, i, axis=0))


def with_a_wall_more(fit: Fit) -> Iterator[Parameters]:
    """The parameters with a middle wall more, where its force takes most of the residuals."""
    trace, parameters = fit.misfit.trace, fit.parameters
    left = trace.force - fit.misfit.forces(parameters)
    model = TraceModel(parameters.needle, trace.depth, trace.time)
    middle = np.median(parameters.membranes, axis=0)
    surface, scaled = MEMBRANE.index("surface"), [MEMBRANE.index(k) for k in ("stiffness", "precompression", "cutting")]
    tried = []
    for place in np.linspace(float(trace.depth.min()), float(trace.depth.max()), PLACES + 2)[1:-1]:
        row = middle.copy()
        row[surface] = place
        force, _ = model.forces([row], parameters.coupling, False)
        square = float(force @ force)
        share = float(force @ left) / square if square > 0 else 0.0
        if share > 0:
            row[scaled] *= min(share, 2.0)
            tried.append((share**2 * square, row))
    for _, row in sorted(tried, key=lambda one: -one[0])[:KEPT]:
        yield replace(parameters, membranes=np.vstack((parameters.membranes, row)))


def _grips(parameters: Parameters) -> np.ndarray:
    """Stiffness times the needle's diameter plus precompression of each wall, N."""
    rows = parameters.membranes
    stiffness, precompression = MEMBRANE.index("stiffness"), MEMBRANE.index("precompression")
    return np.asarray(rows[:, stiffness] * parameters.needle.diameter + rows[:, precompression])

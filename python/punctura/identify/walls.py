"""Start values for one membrane fewer or more than a fit has."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from punctura._core import TraceModel
from punctura.identify.fit import Fit
from punctura.identify.parameters import MEMBRANE, Parameters
from punctura.trace import Segments

PLACES = 24  # where one more wall is tried
KEPT = 3  # of them


def without_a_wall(fit: Fit, segments: Segments) -> Iterator[Parameters]:
    """The parameters without the wall of the smallest pop, and without the wall that resists least."""
    parameters = fit.parameters
    pops = TraceModel.pop_depths(parameters.needle, parameters.membranes, parameters.coupling)[0]
    depths = parameters.membranes[:, MEMBRANE.index("surface")] + pops
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

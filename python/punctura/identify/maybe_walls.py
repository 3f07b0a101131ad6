"""Walls that may be none: none pops, slow noise changes as much in the time of a fall, or noise has split one wall."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from punctura._core import TraceModel
from punctura.identify.causes import Cause
from punctura.identify.fit import Fit

TOLD = 4.0  # standard deviations of a change of the noise, by which a wall falls at least
MOST = 0.9  # of a fall: so much of it tells its time
APART = 3  # samples: two walls that pop nearer to each other may be one


def maybe_walls(fit: Fit, pops: bool) -> tuple[Cause, ...]:
    """The cause, if the trace does not clearly show one of several walls. fit: the last one. pops: the trace has one.

    The force of all walls together is there for certain, and turns its sign with the motion. That it is of several
    walls, their falls tell.
    """
    parameters, trace = fit.parameters, fit.misfit.trace
    if len(parameters.membranes) < 2:
        return ()
    mixture, variance = fit.measured.noise.most_likely()
    model = TraceModel(parameters.needle, trace.depth, trace.time)
    end = int(np.argmax(trace.depth)) + 1
    doubtful, tops = [], []
    if not pops:
        doubtful.append("no wall pops, so only the shape of the rise tells how many there are")
    for i, wall in enumerate(parameters.membranes):
        force = model.forces([wall], parameters.coupling, False)[0][:end]
        top = int(np.argmax(force))
        fall = float(force[top] - force[top:].min())
        samples = int(np.argmax(force[top:] <= force[top] - MOST * fall))
        change = float(np.sqrt(-2 * mixture.share * variance * np.expm1(-max(samples, 1) / mixture.length)))
        tops.append((top, i))
        if fall < TOLD * change:
            doubtful.append(
                f"membrane[{i}] falls by {fall:.2g} N, and slow noise changes by {change:.2g} N (rms) in that time"
            )
    for (one, i), (other, j) in pairwise(sorted(tops)):
        if other - one <= APART and other < end - 1:
            doubtful.append(f"membrane[{i}] and membrane[{j}] pop within {APART} samples, and may be one wall")
    if not doubtful:
        return ()
    text = (
        f"Some walls may be none: {'; '.join(doubtful)}. The other values follow from the number of walls. To tell: "
        "go through all walls, and insert again: a wall comes at the same depth"
    )
    return (Cause("maybe_wall", 0.0, text),)

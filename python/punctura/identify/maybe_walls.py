"""Walls that may be slow noise of the sensor: they fall by no more than the noise changes in the same time."""

from __future__ import annotations

import numpy as np

from punctura._core import TraceModel
from punctura.identify.causes import Cause
from punctura.identify.fit import Fit

TOLD = 4.0  # standard deviations of a change of the noise, by which a wall falls at least
MOST = 0.9  # of a fall: so much of it tells its time


def maybe_walls(fit: Fit) -> tuple[Cause, ...]:
    """The cause, if one of several walls falls by less than slow noise may. fit: the last one.

    The force of all walls together is there for certain, and turns its sign with the motion. That it is of several
    walls, their falls tell.
    """
    parameters, trace = fit.parameters, fit.misfit.trace
    if len(parameters.membranes) < 2:
        return ()
    mixture, variance = fit.measured.noise.most_likely()
    if mixture.share == 0:
        return ()
    model = TraceModel(parameters.needle, trace.depth, trace.time)
    end = int(np.argmax(trace.depth)) + 1
    doubtful = []
    for i, wall in enumerate(parameters.membranes):
        force = model.forces([wall], parameters.coupling, False)[0][:end]
        top = int(np.argmax(force))
        fall = float(force[top] - force[top:].min())
        samples = int(np.argmax(force[top:] <= force[top] - MOST * fall))
        change = float(np.sqrt(-2 * mixture.share * variance * np.expm1(-max(samples, 1) / mixture.length)))
        if fall < TOLD * change:
            doubtful.append((f"membrane[{i}]", fall, change))
    if not doubtful:
        return ()
    told = "; ".join(f"{name} falls by {fall:.2g} N, and this noise changes by {change:.2g} N (rms)"
                     for name, fall, change in doubtful)  # fmt: skip
    text = (
        f"The force moves slowly about the model, so some walls may be none. In the time of its fall, {told}. The "
        "other values follow from the number of walls. To tell: insert again: a wall comes at the same depth"
    )
    return (Cause("maybe_wall", 0.0, text),)

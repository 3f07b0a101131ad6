"""Whether a trace begins and ends in air: friction that a rest keeps is as level as the zero of a sensor.

A needle that is in tissue, or on a slide with friction, is pushed at the beginning and pulled at the end. So the force
falls from one end to the other, and drifts at neither of them.
"""

from __future__ import annotations

import numpy as np

from punctura.trace.air import FEWEST, slope
from punctura.trace.trace import Trace
from punctura.trace.turns import noise_of

SMALL, LARGE = 0.03, 0.1  # of the greatest force: a smaller change does not matter; a larger one may be friction
NOISES = 5.0  # that a change is larger than
EVEN, SURE = 0.5, 3.0  # of a change, that a drift of both ends explains; standard errors of this drift
SHALLOWER = 0.01  # of the range of the depths
ALIKE = 0.1  # of a change: nearer to 0 is its middle where friction is alike on both ways, and the sensor was zeroed
NO_AIR = "no_air"  # the finding


def without_zero(trace: Trace) -> bool:
    """Whether a finding says that no air shows the zero of the force: its level differs between the two ends."""
    return any(finding.kind == NO_AIR for finding in trace.findings)


def fallen(trace: Trace, contact: int, out: int) -> tuple[float, float] | None:
    """The levels of the force up to the contact, and from the exit `out` on, N, if the force has fallen between them.

    None if it has not, or if a drift that the two ends show may explain it.
    """
    time = np.arange(len(trace), dtype=np.float64) if trace.time is None else trace.time
    ends = [slice(0, contact + 1), slice(out, len(trace))]
    begin, end = (float(np.median(trace.force[one])) for one in ends)
    height = float(np.max(np.abs(trace.force - begin)))
    if begin - end <= max(SMALL * height, NOISES * noise_of(trace.force)):
        return None
    span = float(np.mean(time[ends[1]]) - np.mean(time[ends[0]]))
    rises = [slope(time[one], trace.force[one]) for one in ends if one.stop - one.start >= FEWEST]
    weights = [1 / max(error, 1e-9 * height / span) ** 2 for _, error in rises]
    if not rises:
        return None
    rise = sum(weight * one for weight, (one, _) in zip(weights, rises, strict=True)) / sum(weights)
    drift = span * (SURE / np.sqrt(sum(weights)) - rise)
    return (begin, end) if drift < EVEN * (begin - end) else None


def begins_in_tissue(trace: Trace, contact: int, out: int) -> bool:
    """Whether a force that has fallen is that of tissue at the beginning.

    It rises as soon as the needle moves, or comes to its last level only where the trace never was before.
    """
    near = SHALLOWER * float(np.ptp(trace.depth))
    return bool(trace.depth[contact] < trace.depth[0] + near or trace.depth[out] < trace.depth[0] - near)


def rubbed(trace: Trace, contact: int | None, out: int | None) -> tuple[float, float] | None:
    """The levels of both ends, N, if they may be friction on the way in and on the way out; None if not."""
    if contact is None or out is None:
        return None
    levels = fallen(trace, contact, out)
    if levels is None:
        return None
    change, height = levels[0] - levels[1], float(np.max(np.abs(trace.force - levels[0])))
    return levels if change > LARGE * height or abs(levels[0] + levels[1]) < ALIKE * change else None

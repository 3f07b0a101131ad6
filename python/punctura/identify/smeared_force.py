"""A force that a program has smoothed or filled in: only samples that are independent count, and a time is in doubt."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from punctura.identify.intervals import Estimate
from punctura.identify.parameters import kind_of
from punctura.identify.rig import Rig
from punctura.trace import Segments, Trace
from punctura.trace.samples import smeared

LEAST = 20  # samples that are left


def without_smeared(trace: Trace, segments: Segments) -> tuple[Trace, float]:
    """Every k-th sample of a force that is smoothed over k samples, as the air shows it; and these samples' time, s.

    The model gives a sample in which a wall pops the mean over its way, as such a filter does. The same trace and 0
    come back where nothing is smoothed; 0 without time.
    """
    width = min(smeared(*segments.air(trace.force)), len(trace) // LEAST)
    if width < 2:
        return trace, 0.0
    few = trace[::width]
    return few, 0.0 if few.time is None else float(few.time[-1] - few.time[0]) / (len(few) - 1)


def smeared_rig(rig: Rig, time: float) -> Rig:
    """The rig with the delay that a filter over this time, s, may have: a symmetric one has none."""
    return replace(rig, delay=rig.delay or 0.0, delay_tolerance=max(rig.delay_tolerance, time))


def smeared_walls(found: Sequence[Estimate], trace: Trace) -> tuple[Estimate, ...]:
    """The estimates, where each wall may be thinner by the way between two samples: so far a filter smears its pop.

    A filter that makes the force late, in a form that is not known, makes the spring seem softer.
    """
    way = float(np.median(np.abs(np.diff(trace.depth))))
    late = any(one.name in ("lag", "delay") for one in found)
    return tuple(
        replace(one, low=None if one.low is None or one.low <= way else one.low - way)
        if kind_of(one.name) == "thickness"
        else replace(one, high=None)
        if late and one.name == "coupling_stiffness"
        else one
        for one in found
    )


def smeared_words(before: Trace, after: Trace) -> tuple[str, ...]:
    """A sentence for a trace of which samples are left out."""
    if len(after) == len(before):
        return ()
    return (
        f"The force was smoothed or filled in, so {len(after)} of {len(before)} samples are used, and the intervals "
        "allow for a filter that is late by the time between them, for thinner walls and, if the force comes late, "
        "for a stiffer spring. "
        "Export the force as it is measured.",
    )

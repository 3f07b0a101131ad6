"""Determines the stage of each tick of a run from the phases of the core."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from punctura import Phase

OUTSIDE, INSERTION, REVERSAL, WITHDRAWAL = "outside", "insertion", "reversal", "withdrawal"


def stages(phase: NDArray[np.uint8]) -> NDArray[np.str_]:
    """The stage of each tick, from phases (n ticks, m membranes). The needle slides if it slides in all membranes.

    Encoder positions are quantized, so a sliding proxy sticks between two counts. A sticking interval belongs to the
    slide around it if both sides slide in the same direction; otherwise it is a reversal.
    """
    out_of = phase == int(Phase.outside)
    slides_in = ((phase == int(Phase.sliding_in)) | out_of).all(axis=1)
    slides_out = ((phase == int(Phase.sliding_out)) | out_of).all(axis=1)
    outside = out_of.all(axis=1)
    marks = np.where(outside, 2, slides_in * 1 - slides_out * 1)
    before, after = _last_mark(marks), _last_mark(marks[::-1])[::-1]
    # A sticking tick between outside and a slide belongs to the slide.
    before = np.where(before == 2, after, before)
    after = np.where(after == 2, before, after)
    result = np.full(marks.shape, REVERSAL, dtype="<U10")
    result[(before == 1) & (after == 1)] = INSERTION
    result[(before == -1) & (after == -1)] = WITHDRAWAL
    result[outside] = OUTSIDE
    return result


def _last_mark(marks: NDArray[np.int64]) -> NDArray[np.int64]:
    """For each index the last nonzero mark up to and including it; 0 before the first."""
    places = np.maximum.accumulate(np.where(marks != 0, np.arange(marks.size), 0))
    return np.asarray(marks[places])

"""What the needle is about, read from the phases that the core reports tick by tick."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from punctura import Phase

OUTSIDE, INSERTION, REVERSAL, WITHDRAWAL = "outside", "insertion", "reversal", "withdrawal"


def stages(phase: NDArray[np.uint8]) -> NDArray[np.str_]:
    """The stage of each tick, from phases (n ticks, m membranes). The needle slides where it slides in every membrane.

    An encoder moves in counts, so that a proxy which slides in sticks between two of them. A stretch of sticking
    belongs to the slide on both of its sides where they agree, and is a reversal where they do not.
    """
    out_of = phase == int(Phase.outside)
    slides_in = ((phase == int(Phase.sliding_in)) | out_of).all(axis=1)
    slides_out = ((phase == int(Phase.sliding_out)) | out_of).all(axis=1)
    outside = out_of.all(axis=1)
    marks = np.where(outside, 2, slides_in * 1 - slides_out * 1)
    before, after = _last_mark(marks), _last_mark(marks[::-1])[::-1]
    # A tick at rest between outside and a slide belongs to the slide.
    before = np.where(before == 2, after, before)
    after = np.where(after == 2, before, after)
    result = np.full(marks.shape, REVERSAL, dtype="<U10")
    result[(before == 1) & (after == 1)] = INSERTION
    result[(before == -1) & (after == -1)] = WITHDRAWAL
    result[outside] = OUTSIDE
    return result


def _last_mark(marks: NDArray[np.int64]) -> NDArray[np.int64]:
    """At each place the last mark that is not 0, itself included; 0 before the first."""
    places = np.maximum.accumulate(np.where(marks != 0, np.arange(marks.size), 0))
    return np.asarray(marks[places])

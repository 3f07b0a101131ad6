"""The samples that a fit does not see, to ask how well it predicts them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from punctura.trace.segment import Segments

BLOCKS, FOLDS = 20, 4


def held_out(samples: int, segments: Segments) -> list[NDArray[np.bool_]]:
    """Masks (n,) of the samples that each fold leaves out: every fourth of 20 blocks, without the pops.

    A pop and its neighbours are never left out: its place is a parameter of its own, which nothing else in the trace
    tells. The masks depend on the trace alone, so they are the same for all models that are compared.
    """
    block = np.arange(samples) * BLOCKS // samples
    near = max(3, samples // 100)
    free = np.ones(samples, bool)
    for pop in segments.pops:
        free[max(0, pop.start - near) : pop.end + near + 1] = False
    masks = [(block % FOLDS == fold) & free for fold in range(FOLDS)]
    return [mask for mask in masks if mask.any()]

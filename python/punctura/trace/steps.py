"""The steps of a sensor that gives only multiples of one."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

DIGITS = 1e-9  # of the range of the values: differences as small are of the computer
OFF = 0.1  # of a step, rms: values that are farther off lie on no grid; by chance they are off by 0.29
FEWEST, PARTS = 4, 5  # differences that show a step; the least one may be so many steps
MANY = 10  # samples for each value: fewer differences show a step, too, where the values come again so often


def rounding(values: Array) -> float:
    """The standard deviation of the rounding to multiples of a step, in the unit of values; 0 if there is none."""
    apart = np.diff(np.unique(values))
    apart = apart[apart > DIGITS * float(np.ptp(values))]
    few = min(len(apart), 1) if len(values) >= MANY * (len(apart) + 1) else 0
    for parts in range(1, 1 + (PARTS if len(apart) >= FEWEST else few)):
        step = float(apart.min()) / parts
        for _ in range(2):  # a file may give the step itself in few digits
            step = float(apart.sum() / np.round(apart / step).sum())
        off = apart / step - np.round(apart / step)
        if np.sqrt(np.mean(off**2)) < OFF:
            return float(step / np.sqrt(12))
    return 0.0


def equal_runs(values: Array) -> NDArray[np.int64]:
    """The first sample of each run of equal values, and behind the last one their number (runs + 1,)."""
    return np.concatenate(([0], np.flatnonzero(np.diff(values)) + 1, [len(values)]))

"""Friction of a rig's slide that a rest keeps, and that rises over a short way where the slide turns."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

AT_ONCE = 1e-12  # m: over less, friction rises at once


@dataclass(frozen=True, eq=False)
class Slide:
    """How a slide moves, at some of the samples of a trace. Noise of the depth is no motion."""

    way: Array  # (n,) m, how far it went in all, from the first sample of the trace on
    starts: Array  # (t,) m, the way at which each motion in one direction begins
    signs: Array  # (t,) 1: inwards

    def __getitem__(self, which: slice | NDArray[Any]) -> Slide:
        return replace(self, way=self.way[which])

    @cached_property
    def _motion(self) -> NDArray[np.int64]:
        """Which motion each sample belongs to, from 1 on; a rest belongs to the one before, at first to 0."""
        return np.searchsorted(self.starts, self.way)

    @property
    def step(self) -> float:
        """A typical way from sample to sample, m, where it moves."""
        steps = np.diff(self.way)
        return float(np.median(steps[steps > 0]))

    def kept(self, over: float) -> tuple[Array, Array]:
        """Friction that a rest keeps and that rises over so many m, in parts of itself (n,): from 0 on, and
        what is left of the friction before the first sample.
        """
        return self.kept_and_slopes(over)[:2]

    def kept_and_slopes(self, over: float) -> tuple[Array, Array, Array, Array]:
        """As kept(), and the derivatives of both by `over`, 1/m."""
        over = max(over, AT_ONCE)
        last, slope = 0.0, 0.0  # where a motion begins
        rows = [(0.0, 0.0, 0.0, 0.0)]
        for sign, start, end in zip(self.signs, self.starts, [*self.starts[1:], np.inf], strict=True):
            rows.append((sign, start, last - sign, slope))
            left, far = float(np.exp((start - end) / over)), min((end - start) / over, 1e3)
            slope = left * (slope + (last - sign) * far / over)
            last = sign + (last - sign) * left
        sign, start, away, slopes = np.array(rows)[self._motion].T
        far, first = (self.way - start) / over, self.way / over
        left, before = np.exp(-far), np.exp(-first)
        return sign + away * left, before, left * (slopes + away * far / over), before * first / over


def friction_of_slide(slide: Slide, friction: float, before: float, over: float) -> tuple[Array, Array]:
    """What friction that a rest keeps adds to the force, N (n,), and its derivatives by these values (n, 3)."""
    found, left, by_way, left_by_way = slide.kept_and_slopes(over)
    return friction * found + before * left, np.column_stack((found, left, friction * by_way + before * left_by_way))

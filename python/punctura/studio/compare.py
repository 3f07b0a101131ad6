"""The other solver beside the present one, on the same samples: for the eye only, no hand feels it."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from punctura import Insertion, Scene
from punctura.studio.wire.frames import Columns


class OtherSolver:
    """Begins as soon as the tip is outside every membrane, where both solvers agree; until then its force is NaN."""

    def __init__(self, scene: Scene) -> None:
        self.take(scene)

    def take(self, scene: Scene) -> None:
        """From the next `run` on, for this scene."""
        other = "paper" if scene.servo.solver == "exact" else "exact"
        self._insertion = Insertion(scene.replace(servo=scene.servo.replace(solver=other)))
        self._begun = False

    def run(self, columns: Columns) -> npt.NDArray[Any]:
        """Its force (n, 3), N, for ticks that follow those of the call before."""
        n = len(columns["tick"])
        force = np.full((n, 3), np.nan)
        good = np.isfinite(columns["position"]).all(axis=1) & np.isfinite(columns["axis"]).all(axis=1)
        good &= columns["fault"] == 0
        outside = (columns["phase"] == 0).all(axis=1)
        at = 0
        while at < n:
            if not self._begun:
                begin = np.flatnonzero((good & outside)[at:])
                if len(begin) == 0:
                    return force
                at += int(begin[0])
                self._insertion.reset()
                self._begun = True
            bad = np.flatnonzero(~good[at:])
            end = at + int(bad[0]) if len(bad) else n
            if end > at:
                force[at:end] = self._insertion.run(columns["position"][at:end], columns["axis"][at:end]).force
            self._begun = end == n
            at = end
        return force

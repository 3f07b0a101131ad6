"""Runs the other solver on the same samples, for display only: its force never goes to the device."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from punctura import Insertion, Phase, Scene
from punctura.ticks import ABSENT, Ticks


class OtherSolver:
    """Starts once the tip is outside every membrane, where both solvers agree; its force is NaN before."""

    def __init__(self, scene: Scene) -> None:
        self.take(scene)

    def take(self, scene: Scene) -> None:
        """Uses this scene from the next `run` on."""
        other = "paper" if scene.servo.solver == "exact" else "exact"
        self._insertion = Insertion(scene.replace(servo=scene.servo.replace(solver=other)))
        self._begun = False

    def run(self, ticks: Ticks) -> npt.NDArray[Any]:
        """The other solver's force (n, 3), N. The ticks must follow those of the last call."""
        n = len(ticks)
        force = np.full((n, 3), np.nan)
        good = np.isfinite(ticks.position).all(axis=1) & np.isfinite(ticks.axis).all(axis=1)
        good &= ticks.fault == 0
        outside = ((ticks.phase == Phase.outside.value) | (ticks.phase == ABSENT)).all(axis=1)
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
                force[at:end] = self._insertion.run(ticks.position[at:end], ticks.axis[at:end]).force
            self._begun = end == n
            at = end
        return force

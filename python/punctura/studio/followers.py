"""What follows the ticks of a run if a page asks for it: the other solver's force, and the live estimate."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from punctura import Insertion, Phase, Scene
from punctura._core import LiveEstimate
from punctura.studio.wire.messages import Estimated, EstimateMessage, FoundPuncture
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


SEND_EVERY_S = 0.25
INTERVAL = 1.96  # standard deviations on either side of a 95 % interval


class Estimator:
    """Takes the ticks of one run. Depth and force are those of the model: along the first membrane's normal and along
    the needle."""

    def __init__(self, scene: Scene, rate: float) -> None:
        self._period = 1 / rate
        self._live = LiveEstimate()
        self._sent = -np.inf  # time of the last message, s
        self.change(scene)

    def change(self, scene: Scene) -> None:
        """The run goes on with another scene."""
        normal = np.asarray(scene.membranes[0].inward_normal)
        self._normal = normal / np.linalg.norm(normal)
        self._point = np.asarray(scene.membranes[0].point)

    def add(self, ticks: Ticks) -> EstimateMessage | None:
        """The message for the pages, if one is due or a puncture was found."""
        depth = (ticks.tip - self._point) @ self._normal
        force = -np.sum(ticks.model_force * ticks.axis, axis=1)
        found = np.flatnonzero(self._live.run(depth, force, self._period)["punctured"])
        now = float(ticks.time[-1])
        if not len(found) and 0 <= now - self._sent < SEND_EVERY_S:
            return None
        self._sent = now
        live = self._live
        return EstimateMessage(
            on=True,
            phase=live.phase,
            slope=_estimated(live.slope),
            plateau=_estimated(live.plateau),
            punctures=live.punctures,
            drop=live.drop,
            ignored=live.ignored,
            found=[FoundPuncture(tick=int(ticks.tick[i]), depth=float(depth[i])) for i in found],
        )


def no_estimate() -> EstimateMessage:
    """Nothing is estimated."""
    return EstimateMessage(on=False, phase="free", slope=None, plateau=None, punctures=0, drop=0.0, ignored=0, found=[])


def _estimated(value: tuple[float, float] | None) -> Estimated | None:
    return None if value is None else Estimated(value=value[0], half=INTERVAL * value[1])

"""Measures what follows when the plunger gives way: the injected volume, and how long the thumb goes on pushing."""

from __future__ import annotations

import numpy as np

from punctura.exercise.result import Yield
from punctura.exercise.ticks import Ticks

REACTION_S = 0.3  # a thumb reacts within it; illustrative


class YieldMeasures:
    """Takes all ticks of an attempt, with `gave_way` filled in."""

    def __init__(self, seconds: float) -> None:
        """seconds: length of the measurement."""
        self._seconds = seconds
        self._volumes: list[float] = []  # m^3, that had left the syringe when it gave way
        self.found: list[Yield] = []

    def begin(self, ticks: Ticks) -> None:
        for row in np.flatnonzero(ticks.gave_way).tolist():
            self._volumes.append(float(ticks.injected[row]))
            time, push = float(ticks.time[row]), float(ticks.load[row])
            self.found.append(Yield(time=time, push=push, injected=0.0, seconds=self._seconds))

    def settle(self, ticks: Ticks) -> None:
        for k, one in enumerate(self.found):
            rows = (ticks.time >= one.time) & (ticks.time <= one.time + one.seconds) & np.isfinite(ticks.injected)
            if not rows.any():
                continue
            injected = float(ticks.injected[rows].max()) - self._volumes[k]
            late = ticks.push[rows & (ticks.time >= one.time + REACTION_S)]
            pushes = [*late[np.isfinite(late)].tolist(), *([] if one.push_after is None else [one.push_after])]
            update = {"injected": max(one.injected, injected), "push_after": max(pushes, default=None)}
            self.found[k] = one.model_copy(update=update)

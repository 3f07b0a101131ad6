"""Measures the felt loss of resistance at each pop of an attempt."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from punctura import Scene
from punctura.events import Event
from punctura.exercise.loss import needed_drop
from punctura.exercise.result import Loss
from punctura.exercise.ticks import JudgedTicks


@dataclass
class _Grip:
    """The strongest hold of one membrane since the tip went in or popped it."""

    resistance: float = -np.inf  # N, of this membrane
    felt: float = 0.0  # N, along the needle, at that tick
    model: float = 0.0
    ceiling: float = np.inf  # N, the lowest since that tick


class Losses:
    """Takes all ticks of an attempt and their events, in batches of any size.

    The loss is the felt force at the membrane's largest resistance less the felt force at the pop. A limit that falls
    in between makes a drop of its own, which is no loss of resistance: so the first force counts only as far as the
    limits permitted it until the pop.
    """

    def __init__(self, scene: Scene, must: Collection[int]) -> None:
        """must: the membranes whose loss must be felt."""
        self._names = [placed.name for placed in scene.membranes]
        self._must = must
        self._grips = [_Grip() for _ in self._names]
        self.found: list[Loss] = []

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        pops = [event for event in events if event.what == "pop"]
        for i in range(len(self._names)):
            start = 0
            for pop in pops:
                if pop.membrane != i:
                    continue
                end = int(np.searchsorted(ticks.tick, pop.tick)) + 1
                self._hold(i, ticks.part(slice(start, end)))
                self.found.append(self._loss(pop, ticks.part(slice(end - 1, end))))
                self._grips[i] = _Grip()
                start = end
            self._hold(i, ticks.part(slice(start, len(ticks))))
        self.found.sort(key=lambda loss: (loss.time, loss.membrane))

    def _hold(self, i: int, ticks: JudgedTicks) -> None:
        outside = np.flatnonzero(~ticks.inside[:, i])
        if len(outside):
            self._grips[i] = _Grip()
            ticks = ticks.part(slice(int(outside[-1]) + 1, len(ticks)))
        if len(ticks) == 0:
            return
        grip = self._grips[i]
        resistance = np.where(np.isfinite(ticks.resistance[:, i]), ticks.resistance[:, i], -np.inf)
        most = int(resistance.argmax())
        if resistance[most] > grip.resistance:
            grip = _Grip(float(resistance[most]), float(ticks.felt[most]), float(ticks.model[most]))
            self._grips[i] = grip
            ticks = ticks.part(slice(most, len(ticks)))
        grip.ceiling = min(grip.ceiling, float(np.fmin.reduce(ticks.ceiling)))

    def _loss(self, pop: Event, now: JudgedTicks) -> Loss:
        grip = self._grips[pop.membrane]
        before = max(0.0, min(grip.felt, grip.ceiling))
        return Loss(
            membrane=pop.membrane,
            name=pop.name,
            time=pop.time,
            before=before,
            after=float(now.felt[0]),
            model_before=grip.model,
            model_after=float(now.model[0]),
            force_scale=float(now.force_scale[0]),
            needed=needed_drop(before) if pop.membrane in self._must else None,
        )

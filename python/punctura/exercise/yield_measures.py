"""Measures what follows when the plunger gives way: the injected volume, how long the thumb goes on pushing, and how
much of the loss of resistance it felt."""

from __future__ import annotations

import numpy as np

from punctura.exercise.loss import needed_drop
from punctura.exercise.result import PlungerLoss, Yield
from punctura.exercise.ticks import Flags, Ticks

REACTION_S = 0.3  # a thumb reacts within it; illustrative
ROUNDING_N = 0.01  # a device gives a force with an error of about this


class YieldMeasures:
    """Takes all ticks of an attempt, with `gave_way` filled in."""

    def __init__(self, seconds: float, must: bool, stiffness: float = 0.0) -> None:
        """seconds: length of the measurement. must: whether the thumb must feel the loss of resistance. stiffness: of
        the coupling between thumb and plunger, N/m."""
        self._seconds, self._must, self._stiffness = seconds, must, stiffness
        self._volumes: list[float] = []  # m^3, that had left the syringe when it gave way
        self._farthest: list[float] = []  # m, how far in the thumb has been since then
        self._before: list[float] = []  # N, of the felt force before
        self._seen_to = -np.inf
        self.found: list[Yield] = []

    def begin(self, ticks: Ticks) -> None:
        for row in np.flatnonzero(ticks.gave_way).tolist():
            self._volumes.append(float(ticks.injected[row]))
            self._farthest.append(float(ticks.thumb[row]))
            time, push = float(ticks.time[row]), float(ticks.load[row])
            self._before.append(float(ticks.load_felt[row]))
            loss = self._loss(ticks, row)
            self.found.append(Yield(time=time, push=push, loss=loss, injected=0.0, seconds=self._seconds))

    def _loss(self, ticks: Ticks, row: int) -> PlungerLoss | None:
        before, model = float(ticks.load_felt[row]), float(ticks.load[row])
        if not np.isfinite(before):
            return None
        scale, needed = float(ticks.force_scale[row]), self._needed(before)
        return PlungerLoss(
            before=before, after=before, model_before=model, model_after=model, force_scale=scale, needed=needed
        )

    def _needed(self, before: float) -> float | None:
        return needed_drop(before) if self._must else None

    def settle(self, ticks: Ticks) -> None:
        for k, one in enumerate(self.found):
            rows = (ticks.time >= one.time) & (ticks.time <= one.time + one.seconds) & np.isfinite(ticks.injected)
            if not rows.any():
                continue
            injected = float(ticks.injected[rows].max()) - self._volumes[k]
            late = ticks.push[rows & (ticks.time >= one.time + REACTION_S)]
            pushes = [*late[np.isfinite(late)].tolist(), *([] if one.push_after is None else [one.push_after])]
            update = {"injected": max(one.injected, injected), "push_after": max(pushes, default=None)}
            soon = rows & (ticks.time <= one.time + REACTION_S) & np.isfinite(ticks.push) & np.isfinite(ticks.push_felt)
            if one.loss is not None and soon.any():
                update["loss"] = self._followed(k, one.loss, *self._least(k, one.loss.force_scale, ticks, soon))
            self.found[k] = one.model_copy(update=update)
        if len(ticks):
            self._seen_to = float(ticks.time[-1])

    def _least(self, k: int, scale: float, ticks: Ticks, soon: Flags) -> tuple[float, float]:
        """The least felt and model force of the thumb, N, if it had not been drawn back.

        A thumb that is drawn back feels less force, whether or not the plunger gives way: so each force counts as at
        least that of the coupling to a thumb at its farthest place so far.
        """
        thumb, push = ticks.thumb[soon], ticks.push[soon]
        farthest = np.fmax.accumulate(np.fmax(thumb, self._farthest[k]))
        self._farthest[k] = float(farthest[-1])
        held = np.fmax(push, self._stiffness * (farthest - ticks.plunger[soon]))
        return float((ticks.push_felt[soon] + scale * (held - push)).min()), float(held.min())

    def _followed(self, k: int, loss: PlungerLoss, felt: float, model: float) -> PlungerLoss:
        """The loss with the least forces so far. A limit that cuts the force after it is no loss of resistance: then
        the force before counts only as far."""
        after, model_after = min(loss.after, felt), min(loss.model_after, model)
        wanted = loss.force_scale * model_after
        cut = after < wanted - max(0.01 * abs(wanted), ROUNDING_N)
        before = max(0.0, min(self._before[k], after) if cut else self._before[k])
        update = {"before": before, "after": after, "model_after": model_after, "needed": self._needed(before)}
        return loss.model_copy(update=update)

    @property
    def complete(self) -> list[Yield]:
        """Those after which a thumb could have reacted."""
        return [one for one in self.found if self._seen_to >= one.time + REACTION_S]

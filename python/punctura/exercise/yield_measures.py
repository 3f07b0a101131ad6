"""Measures what follows when the plunger gives way: the injected volume, how long the thumb goes on pushing, and how
much of the loss of resistance it felt."""

from __future__ import annotations

import numpy as np

from punctura.exercise.loss import needed_drop
from punctura.exercise.result import PlungerLoss, Yield
from punctura.exercise.ticks import Flags, JudgedTicks

REACTION_S = 0.3  # a thumb reacts within it; illustrative


class YieldMeasures:
    """Takes all ticks of an attempt, with `gave_way` filled in."""

    def __init__(self, seconds: float, must: bool, stiffness: float = 0.0) -> None:
        """seconds: in which the injected volume is measured. must: whether the thumb must feel the loss of resistance.
        stiffness: of the coupling between thumb and plunger, N/m."""
        self._seconds, self._must, self._stiffness = seconds, must, stiffness
        self._volumes: list[float] = []  # m^3, that had left the syringe when it gave way
        self._farthest: list[float] = []  # m, how far in the thumb has been since the point came out
        self._least: list[float] = []  # N, of the felt force since it gave way, whatever the thumb did
        self._seen_to = -np.inf
        self.found: list[Yield] = []

    def begin(self, ticks: JudgedTicks) -> None:
        for row in np.flatnonzero(ticks.gave_way).tolist():
            self._volumes.append(float(ticks.injected[row]))
            self._farthest.append(float(ticks.farthest[row]))
            self._least.append(np.inf)
            time, push = float(ticks.time[row]), float(ticks.load[row])
            loss = self._loss(ticks, row)
            self.found.append(Yield(time=time, push=push, loss=loss, injected=0.0, seconds=self._seconds))

    def _loss(self, ticks: JudgedTicks, row: int) -> PlungerLoss | None:
        before, model = float(ticks.load_felt[row]), float(ticks.load[row])
        if not np.isfinite(before):
            return None
        scale, needed = float(ticks.force_scale[row]), self._needed(before)
        return PlungerLoss(
            before=before, after=before, model_before=model, model_after=model, force_scale=scale, needed=needed
        )

    def _needed(self, before: float) -> float | None:
        return needed_drop(before) if self._must else None

    def settle(self, ticks: JudgedTicks) -> None:
        for k, one in enumerate(self.found):
            rows = (ticks.time >= one.time) & np.isfinite(ticks.injected)
            soon = rows & (ticks.time <= one.time + REACTION_S) & np.isfinite(ticks.push) & np.isfinite(ticks.push_felt)
            self.found[k] = one = self._injected(k, one, ticks, rows & (ticks.time <= one.time + one.seconds))
            if one.loss is not None and soon.any():
                self.found[k] = one.model_copy(update={"loss": self._followed(k, one.loss, ticks, soon)})
        if len(ticks):
            self._seen_to = float(ticks.time[-1])

    def _injected(self, k: int, one: Yield, ticks: JudgedTicks, rows: Flags) -> Yield:
        if not rows.any():
            return one
        injected = float(ticks.injected[rows].max()) - self._volumes[k]
        late = ticks.push[rows & (ticks.time >= one.time + REACTION_S)]
        pushes = [*late[np.isfinite(late)].tolist(), *([] if one.push_after is None else [one.push_after])]
        update = {"injected": max(one.injected, injected), "push_after": max(pushes, default=None)}
        return one.model_copy(update=update)

    def _followed(self, k: int, loss: PlungerLoss, ticks: JudgedTicks, soon: Flags) -> PlungerLoss:
        """The loss with the least forces so far, for a thumb that had not been drawn back.

        A thumb that is drawn back feels less force, whether or not the plunger gives way: so each force counts as at
        least that of the coupling to a thumb at its farthest place so far. A limit that has cut the force is no loss of
        resistance: then the force before counts only as far.
        """
        push, felt = ticks.push[soon], ticks.push_felt[soon]
        farthest = np.fmax.accumulate(np.fmax(ticks.farthest[soon], self._farthest[k]))
        held = np.fmax(push, self._stiffness * (farthest - ticks.plunger[soon]))
        self._farthest[k], self._least[k] = float(farthest[-1]), min(self._least[k], float(felt.min()))
        kept = felt + loss.force_scale * (held - push)
        row = int(kept.argmin())
        before, after = loss.before, loss.after
        if kept[row] < after:
            before, after = max(0.0, min(before, float(ticks.cut_to[soon][row]))), float(kept[row])
        needed = self._needed(before)
        drawn_back = before - after < needed_drop(before) <= before - self._least[k]
        update = {"model_after": min(loss.model_after, float(held.min())), "drawn_back": drawn_back}
        return loss.model_copy(update={"before": before, "after": after, "needed": needed, **update})

    @property
    def ends(self) -> list[float]:
        """The time at which each measurement ends, s."""
        return [one.time + max(one.seconds, REACTION_S if one.loss else 0.0) for one in self.found]

    @property
    def complete(self) -> list[Yield]:
        """Those after which a thumb could have reacted."""
        return [one for one in self.found if self._seen_to >= one.time + REACTION_S]

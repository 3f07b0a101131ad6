"""How much of a loss of resistance the hand got at each pop, and whether a hand can feel it (docs/felt-force.md)."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from punctura import Scene
from punctura.events import Event
from punctura.exercise.result import FeltLoss, Loss, PlungerLoss, drop_text
from punctura.exercise.ticks import JudgedTicks

# A person notices a change of about 7 % (X. D. Pang, H. Z. Tan, N. I. Durlach, Perception & Psychophysics, 1991,
# forces of 2.5 to 10 N) to 10 % (index finger, 2 to 5 N) of a force. Below 1 N the needed drop stays that of 1 N, which
# is our choice. docs/felt-force.md has the sources.
NEEDED_SHARE = 0.1
LEAST_NEEDED_N = 0.1
DRAWN_BACK = "The thumb was drawn back: keep it on the plunger until it gives way. "


def needed_drop(before: float) -> float:
    """The smallest drop that counts as felt, N. before: the felt force before the pop, N."""
    return max(LEAST_NEEDED_N, NEEDED_SHARE * before)


def remedy(loss: FeltLoss) -> str:
    """What makes the loss larger, as a sentence."""
    wanted = loss.force_scale * loss.model_before
    cut = f"limits cut the force to {loss.before:.2f} of {wanted:.2f} N"
    itself = drop_text(loss.model_before - loss.model_after)
    words = _of_thumb(cut, itself) if isinstance(loss, PlungerLoss) else _of_needle(cut, itself)
    drawn_back = isinstance(loss, PlungerLoss) and loss.drawn_back
    return f"{DRAWN_BACK if drawn_back else ''}{_reason(loss, words, wanted)}"


def _reason(loss: FeltLoss, words: _Words, wanted: float) -> str:
    if loss.before == 0:
        return words.off
    if loss.before < 0.99 * wanted:
        return words.cut
    return words.scaled if loss.force_scale < 1 else words.itself


class _Words(NamedTuple):
    """A sentence for each reason why a loss is too small: no force, a limit, the force scale, the loss itself."""

    off: str
    cut: str
    scaled: str
    itself: str


def _of_needle(cut: str, itself: str) -> _Words:
    return _Words(
        "The force was off: turn it on.",
        f'The {cut}: set force_scale in the scene to "automatic", or use a stronger device.',
        "Set a larger force_scale in the scene, if the device can give it, or use a stronger device.",
        f"In this scene the loss itself is {itself}.",
    )


def _of_thumb(cut: str, itself: str) -> _Words:
    return _Words(
        "The thumb had no force: turn the force on, and rest the thumb on the second device.",
        f"Its {cut}: set a smaller force_scale in the scene, or use a stronger second device.",
        "Push the plunger harder before it gives way, or set a larger force_scale in the scene.",
        f"The loss itself is {itself}: push the plunger harder before it gives way.",
    )


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

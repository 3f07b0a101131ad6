"""How much of a loss of resistance the hand got, and whether a hand can feel it (docs/felt-force.md)."""

from __future__ import annotations

from typing import NamedTuple

from punctura.exercise.result import FeltLoss, PlungerLoss, drop_text

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

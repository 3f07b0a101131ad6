"""Whether a person's answers at the same levels change from block to block."""

from collections.abc import Sequence

import numpy as np
from scipy.special import ndtri

from punctura.perception.protocol import Protocol
from punctura.perception.psychometric import Array
from punctura.perception.results import LEVEL, SHARES, Analysis, Estimate, Person, words


def change(value: Array, block: Array, alike: Sequence[Array], variance: Array | None = None) -> Estimate | None:
    """How much `value` (n,) changes from the first to the last block, along a straight line; None without a second one.

    alike: only trials in which these (n,) are the same are compared. The interval has 0 in it for 95 % of the people
    whose answers do not depend on the block: N. Mantel, Journal of the American Statistical Association 58 (1963) 690.
    variance: of each value, if it is known; default: that of the values that are alike.
    """
    _, cell = np.unique(np.column_stack(alike), axis=0, return_inverse=True)
    count = np.bincount(cell := cell.ravel())
    x, y = (one - (np.bincount(cell, one) / count)[cell] for one in (block, value))
    if not (total := float(x @ x)) > 0:
        return None
    if variance is None:
        variance = (np.bincount(cell, y * y) / np.maximum(count - 1, 1))[cell]
    scale = float(np.ptp(block)) / total
    middle, half = scale * float(x @ y), scale * float(ndtri(SHARES[1]) * np.sqrt(x * x @ variance))
    return Estimate(middle, middle - half, middle + half)


def sentences(protocol: Protocol, found: Analysis) -> list[str]:
    """Who changed more than people do who do not change, and what that does to the threshold."""
    if protocol.rates or protocol.adjusts:
        measures = {"change": "the mean number" if protocol.rates else "the mean setting"}
    else:
        answers = "right answers" if protocol.shape.one_sided or protocol.compares else "yes"
        measures = {"change": f"the share of {answers}"}
        measures |= {"shift": 'the share of "the comparison"'} if protocol.compares else {}
    told, everybody = [], list[tuple[str, Person | Analysis]]((one.participant, one) for one in found.people)
    for name, one in [*everybody, ("The mean of people", found)]:
        for key, what in measures.items():
            amount: Estimate | None = getattr(one, key)
            if amount and not amount.low <= 0 <= amount.high:
                text = f"{name}: at the same levels {what} changed by {words(amount)} from the first block to the last."
                told.append(text + f" {_effect(protocol, key, amount.value > 0)}" * bool(one.slope or one.threshold))
    if told:
        chance = round(1 / (1 - LEVEL) / len(measures))
        told.append(f"Of people who do not change, about one in {chance} is named here.")
    return told


def _effect(protocol: Protocol, key: str, more: bool) -> str:
    if protocol.rates:
        return "The slope stays, since each block has all levels, and its interval has the change in it."
    if protocol.adjusts:
        return "The threshold is that of all blocks together, and the JND takes the change for noise."
    number, less, noise = "threshold", more == protocol.shape.rises, ""
    if protocol.compares and key == "change":
        number, less = "JND", more
    elif protocol.compares:
        noise = " The JND takes the change for noise."
    end = "smaller" if less else "larger"
    return f"The {number} is that of all blocks together; at the end it was most likely {end}.{noise}"

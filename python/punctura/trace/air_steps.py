"""A step of the force where the needle begins to move in air, as friction of the rig's slide makes it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from punctura.trace.friction import Slide
from punctura.trace.steps import rounding
from punctura.trace.trace import Finding, Trace
from punctura.trace.turns import noise_of

Array = NDArray[np.float64]

FEWEST, SURE = 10, 6.0  # samples of the rest; standard errors of a step
MATTERS = 0.02  # of the range of the force
BEGIN, LEVEL = 0.08, 0.6  # of the way in, where friction rises and stays; of its step, that is no longer one
RESTS, SLOWLY = 3, 3.0  # changes in both rests, and times the greatest of them: more is no slow noise


def beginning(trace: Trace, slide: Slide, way: float) -> tuple[Array, Array, Array]:
    """The force in the rest before the first motion, soon after it, and a little later, N."""
    start = int(np.argmax(slide.way > 0))
    gone = slide.way[start:]
    end = start + int(np.argmax(gone > BEGIN * way)) if gone[-1] > BEGIN * way else start
    quarter = start + int(np.argmax(gone > 0.25 * BEGIN * way))
    middle = (quarter + end) // 2
    return trace.force[: max(start - 1, 0)], trace.force[quarter:middle], trace.force[middle:end]


def step(trace: Trace, rest: Array, soon: Array, late: Array) -> float:
    """By how much the force steps where the needle begins to move, N; 0 if it does not, or rises on with the depth."""
    if len(rest) < FEWEST or min(len(soon), len(late)) < 3:
        return 0.0
    first, last = float(np.mean(soon) - np.mean(rest)), float(np.mean(late) - np.mean(soon))
    step, count = first + last, len(soon) + len(late)
    noise = max(noise_of(trace.force), float(np.std(rest)), rounding(trace.force))
    blocks = [float(np.mean(rest[i : i + count])) for i in range(0, len(rest) - count + 1, count)]
    slow = float(np.ptp(blocks)) if len(blocks) > 1 else 0.0
    sure = SURE * noise * np.sqrt(1 / len(rest) + 1 / count) + SURE / 2 * slow
    flat = abs(last) < LEVEL * abs(first)
    return step if flat and abs(step) > max(sure, MATTERS * float(np.ptp(trace.force))) else 0.0


def stands_out(trace: Trace, slide: Slide, rest: Array, soon: Array, late: Array) -> bool:
    """Whether the step at the beginning is greater than what slow noise makes in both rests, over the same time."""
    after = trace.force[int(np.argmax(slide.way == slide.way[-1])) + 1 :]
    width = max((len(soon) + len(late)) // 2, 3)
    means = [one[: len(one) // width * width].reshape(-1, width).mean(axis=1) for one in (rest, after)]
    wander = np.abs(np.concatenate([one[2:] - one[:-2] for one in means]))
    step = float(np.mean(np.concatenate((soon, late))) - np.mean(rest[-width:]))
    return len(wander) >= RESTS and abs(step) > SLOWLY * float(wander.max())


def unexplained(step: float) -> Finding:
    how = "as friction of the slide makes it" if step > 0 else "against the motion, as no friction does"
    text = (
        f"the force in air steps by {step:+.2g} N where the needle begins to move, {how}, "
        "and neither friction that is alike on both ways nor a cable explains the air; nothing is subtracted, so the "
        "model may have walls that are not there. To tell: move the needle over the same depths without tissue"
    )
    return Finding("air_steps", text)

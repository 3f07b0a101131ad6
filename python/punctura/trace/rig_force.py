"""Forces that the rig itself adds, as the air shows them: friction of its slide, and a force that grows with the depth.

Only what both ends of a trace show within themselves counts, so a drift between them is neither.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from punctura.trace.air import smooth
from punctura.trace.segment import segment
from punctura.trace.steps import rounding
from punctura.trace.trace import Finding, Trace
from punctura.trace.turns import noise_of

Array = NDArray[np.float64]

RIG_FORCES = ("slide_friction", "cable_stiffness")  # N, with the sign of the motion; N/m, of the depth
PARTS = (0.7, 0.5, 0.35, 0.25, 0.15, 0.1, 0.05)  # of the way down, that may be air
FEWEST, BLOCK = 40, 10  # samples of air; neighbours whose mean must be no more than noise
SURE, ALIKE = 6.0, 4.0  # standard errors of a force; standard deviations of chance, of what all blocks leave
MATTERS = 0.01  # of the range of the force
ENDING = 2  # kinds of friction that end in a rest
SLOW = 0.3  # of a drift at an end, that may be uneven
BOTH = 0.5  # of the way in air, that the way out must show, too


def _frictions(trace: Trace) -> Iterator[Array]:
    """What friction of 1 N may add to the force (n, 1), or each way by itself (n, 2), in the order of their simplicity.

    It ends in a rest, or a rest keeps that of the last motion; then the first rest has none, or that of a way out. It
    is a mean of three samples, because no stroke is known better; at both ends of a rest, the drive moves or brakes.
    """
    ending, keeping, last = np.zeros(len(trace)), np.zeros(len(trace)), 0.0
    strokes = segment(trace).strokes
    for stroke in strokes:
        last = last if stroke.kind == "hold" else 1.0 if stroke.kind == "in" else -1.0
        keeping[stroke.start : stroke.end] = last
        if stroke.kind != "hold":
            ending[max(stroke.start - 1, 0) : stroke.end + 1] = last
    yield smooth(ending, 3)[:, None]
    yield np.column_stack((smooth(np.maximum(ending, 0.0), 3), smooth(np.minimum(ending, 0.0), 3)))
    yield smooth(keeping, 3)[:, None]
    if strokes[0].kind == "hold":
        keeping[: strokes[0].end] = -1.0
        yield smooth(keeping, 3)[:, None]


def shapes(trace: Trace) -> Array:
    """What 1 N and 1 N/m of RIG_FORCES add to the force (n, 2); 0 for those that the air does not show."""
    return np.zeros((len(trace), len(RIG_FORCES))) if trace.rig is None else trace.rig


def without_rig_force(trace: Trace) -> tuple[Trace, list[Finding]]:
    """The trace without the forces that its air shows, and a finding for each of them."""
    begin = float(trace.depth[0])
    way = float(np.ptp(trace.depth[: int(np.argmax(trace.depth)) + 1]))
    cable = trace.depth - begin
    frictions = list(_frictions(trace))
    for part in PARTS:
        deep = begin + part * way
        found_all = [_in_air(trace, np.column_stack((friction, cable)), deep) for friction in frictions]
        known = [(one, friction) for one, friction in zip(found_all, frictions, strict=True) if one is not None]
        if known:
            break
    else:
        return trace, []
    if any(one is not None for one in found_all[:ENDING]):
        known = known[:1]
    (sizes, _), friction = min(known, key=lambda one: one[0][1])
    least = MATTERS * float(np.ptp(trace.force))
    rubbed = friction @ sizes[:-1]
    size = float(np.max(np.abs(sizes[:-1])))
    seen = np.array([size > least, abs(sizes[-1]) * way > least])
    each = (
        f"{size:.2g} N each way"
        if friction.shape[1] == 1
        else " and ".join(
            f"{abs(one):.2g} N on the way {name}" for one, name in zip(sizes, ("in", "out"), strict=False)
        )
    )
    texts = (
        f"the force in air follows the direction of the motion, by {each}, as friction of the slide makes it; this is "
        "subtracted",
        f"the force in air changes by {1e-3 * sizes[-1]:+.2g} N a mm on both ways, as a cable that pulls makes it, or "
        "a soft layer that follows the needle; this is subtracted, also deeper in",
    )
    found = [Finding(name, text, True) for name, text, one in zip(RIG_FORCES, texts, seen, strict=True) if one]
    if not found:
        return trace, []
    rig = np.column_stack((rubbed / max(size, 1e-300), cable)) * seen
    return replace(trace, force=trace.force - rig @ [size, sizes[-1]], rig=rig), found


def _in_air(trace: Trace, columns: Array, deep: float) -> tuple[Array, float] | None:
    """The sizes of these forces (k,), and the change of the zero between both ends, N; None if more stands there.

    They and noise must be all above the depth `deep`, m. The last one is that of the depth; if it, or the only
    friction, is not clearly there, it is 0. None if none is.
    """
    inside = np.flatnonzero(trace.depth > deep)
    if not len(inside):
        return None
    ends = [slice(0, int(inside[0])), slice(int(inside[-1]) + 1, len(trace))]
    ends = [end for end in ends if end.stop - end.start >= FEWEST]
    if not ends:
        return None
    rows = np.concatenate([np.arange(end.start, end.stop) for end in ends])
    own = [np.isin(rows, np.arange(end.start, end.stop)).astype(float) for end in ends]
    if trace.time is not None:
        own.append(trace.time[rows] - trace.time[0])
    ways = [float(np.ptp(trace.depth[end])) for end in ends]
    told = [any(np.ptp(column[end]) > 0 for end in ends) for column in columns.T]
    told[-1] = len(ends) == 2 and ways[1] > BOTH * ways[0]
    kept = [i for i, one in enumerate(told) if one]
    several = columns.shape[1] - 1
    while kept:
        known = np.column_stack((columns[rows][:, kept], *own))
        scale = np.maximum(np.abs(known).max(axis=0), 1e-300)
        found = np.linalg.lstsq(known / scale, trace.force[rows], rcond=1e-10)[0]
        left = trace.force[rows] - known / scale @ found
        noise = _noise(trace, rows, left)
        if noise is None:
            return None
        error = noise * np.sqrt(np.diag(np.linalg.pinv((known / scale).T @ (known / scale))))
        if trace.time is not None:  # a sensor that drifts in air does not do so evenly
            longest = max(float(np.ptp(trace.time[end])) for end in ends)
            error[: len(kept)] += SLOW * abs(found[-1] / scale[-1]) * longest
        sure = np.abs(found[: len(kept)]) / np.maximum(error[: len(kept)], 1e-300)
        if sure.min() > SURE:
            sizes = np.zeros(columns.shape[1])
            sizes[kept] = (found / scale)[: len(kept)]
            zeros = (found / scale)[len(kept) : len(kept) + len(ends)]
            return (sizes, float(np.ptp(zeros))) if several == 1 or sizes[:several].all() else None
        kept.pop(int(np.argmin(sure)))
    return None


def _noise(trace: Trace, rows: NDArray[np.int64], left: Array) -> float | None:
    """The noise of a sample, N, if that is all that is left (m,) at these rows; slow noise counts as it adds up."""
    count = len(left) // BLOCK
    means = left[: count * BLOCK].reshape(count, BLOCK).mean(axis=1)
    white = max(noise_of(left), rounding(trace.force), 1e-12 * float(np.ptp(trace.force)))
    spread = white**2 / BLOCK
    if float(np.mean(means**2)) > spread * (1 + ALIKE * np.sqrt(2 / count)):
        return None
    return white

"""Forces that the rig itself adds, as the air shows them: friction of its slide, and a force that grows with the depth.

Only what both ends of a trace show within themselves counts, so a drift between them is neither.
"""

from __future__ import annotations

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
SLOW = 1.0  # of a drift at an end, that may be uneven
BOTH = 0.5  # of the way in air, that the way out must show, too


def directions(trace: Trace) -> Array:
    """1 where the needle goes in, -1 where it goes out, 0 where it rests (n,).

    It is a mean of three samples, because no stroke is known better; at both ends of a rest, the drive moves or brakes.
    """
    found = np.zeros(len(trace))
    for stroke in segment(trace).strokes:
        if stroke.kind != "hold":
            found[max(stroke.start - 1, 0) : stroke.end + 1] = 1.0 if stroke.kind == "in" else -1.0
    return smooth(found, 3)


def shapes(trace: Trace) -> Array:
    """What 1 N and 1 N/m of RIG_FORCES add to the force (n, 2); 0 for those that no finding names."""
    named = [any(finding.kind == name for finding in trace.findings) for name in RIG_FORCES]
    if not any(named):
        return np.zeros((len(trace), len(RIG_FORCES)))
    return np.asarray(np.column_stack((directions(trace), trace.depth - trace.depth[0])) * named)


def without_rig_force(trace: Trace) -> tuple[Trace, list[Finding]]:
    """The trace without the forces that its air shows, and a finding for each of them."""
    columns = np.column_stack((directions(trace), trace.depth - trace.depth[0]))
    way = float(np.ptp(trace.depth[: int(np.argmax(trace.depth)) + 1]))
    for part in PARTS:
        sizes = _in_air(trace, columns, float(trace.depth[0]) + part * way)
        if sizes is not None:
            break
    else:
        return trace, []
    least = MATTERS * float(np.ptp(trace.force))
    seen = np.array([abs(sizes[0]) > least, abs(sizes[1]) * way > least])
    sizes = np.where(seen, sizes, 0.0)
    texts = (
        f"the force in air follows the direction of the motion, by {abs(sizes[0]):.2g} N each way, as friction of the "
        "slide makes it; this is subtracted",
        f"the force in air changes by {1e-3 * sizes[1]:+.2g} N a mm on both ways, as a cable that pulls makes it; this "
        "is subtracted, also in the tissue",
    )
    found = [Finding(name, text, True) for name, text, one in zip(RIG_FORCES, texts, seen, strict=True) if one]
    return replace(trace, force=trace.force - columns @ sizes), found


def _in_air(trace: Trace, columns: Array, deep: float) -> Array | None:
    """The sizes of these forces (2,), if they and noise are all that stands above the depth `deep`, m, at both ends.

    One that is not clearly there is 0. None if none is, or if more stands there.
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
    turns = any(np.ptp(columns[end, 0]) > 0 for end in ends)
    kept = [i for i, told in enumerate((turns, len(ends) == 2 and ways[1] > BOTH * ways[0])) if told]
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
            sizes = np.zeros(len(RIG_FORCES))
            sizes[kept] = (found / scale)[: len(kept)]
            return sizes
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

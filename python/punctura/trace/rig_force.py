"""Forces that the rig itself adds, as the air shows them: friction of its slide, and a force that grows with the depth.

Friction is 0 in a rest, or stays as it was in the last motion, and rises over a short way where the slide turns. Of
these forms, the one that leaves less is taken. Only what both ends of a trace show within themselves counts, so a drift
between them is neither.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from punctura.trace import air_steps
from punctura.trace.friction import Slide, friction_of_slide
from punctura.trace.slide import ending, slide_of
from punctura.trace.steps import rounding
from punctura.trace.trace import Finding, Trace
from punctura.trace.turns import noise_of

Array = NDArray[np.float64]

# N, against the motion: on both ways, or on the way in, and then on the way out; N, kept from before the first sample;
# m, over which it rises where the slide turns; N/m, of the depth
RIG_FORCES = ("slide_friction", "slide_friction_out", "slide_friction_before", "slide_way", "cable_stiffness")
FOUND = RIG_FORCES[0], RIG_FORCES[-1]  # the findings
KEPT = 0, 2, 3  # those of friction that a rest keeps: the last one is of no force itself
BEFORE, SLIDE_WAY = KEPT[1:]
PARTS = (0.7, 0.5, 0.35, 0.25, 0.15, 0.1, 0.05)  # of the way down, that may be air
FEWEST, BLOCK = 40, 10  # samples of air; neighbours whose mean must be no more than noise
SURE, ALIKE = 6.0, 4.0  # standard errors of a force; standard deviations of chance, of what all blocks leave
EACH, UNCLEAR = 3.0, 1e4  # standard errors of a cable at one end; a condition number, with which its ends are one
MATTERS = 0.01  # of the range of the force
SLOW = 0.3  # of a drift at an end, that may be uneven
BOTH = 0.5  # of the way in air, that the way out must show, too
WAYS = (0.0, *np.geomspace(2e-6, 1e-3, 19))  # m: over which friction rises by a factor of 1 - 1/e, and finer ones
FINER = 6  # between two of them
SHORTEST = 0.5  # of the way between two samples: they do not tell a shorter one
QUICK = 0.3  # of a friction: two samples between which it rises by more tell only when the slide began to move
ITSELF = 1.15  # times the friction that a slide keeps from before: it is no more than itself


def shapes(trace: Trace) -> Array:
    """What 1 N, 1 m and 1 N/m of RIG_FORCES add to the force (n, 5); 0 for those that the air does not show."""
    return np.zeros((len(trace), len(RIG_FORCES))) if trace.rig is None else trace.rig


def without_rig_force(trace: Trace) -> tuple[Trace, list[Finding]]:
    """The trace without the forces that its air shows, and a finding for each of them.

    Or a finding of friction that is there, and that nothing here explains.
    """
    begin = float(trace.depth[0])
    way = float(np.ptp(trace.depth[: int(np.argmax(trace.depth)) + 1]))
    cable, frictions, slide = trace.depth - begin, ending(trace), slide_of(trace)
    soon = air_steps.beginning(trace, slide, way)
    step = air_steps.step(trace, *soon)
    unexplained = [air_steps.unexplained(step)] if step and air_steps.stands_out(trace, slide, *soon) else []
    keeping = _Keeping(trace, slide, bool(unexplained))
    best: list[tuple[_Friction, _Found]] = []
    for part in PARTS:
        deep = begin + part * way
        tried = ((friction, _resting(trace, np.column_stack((friction, cable)), deep)) for friction in frictions)
        best = [(_Friction(friction), found) for friction, found in tried if found is not None][:1]
        if step and (stays := keeping.found(deep)) is not None:
            best.append(stays)
        if best:
            break
    if not best:
        return trace, unexplained
    friction, chosen = best[_least([one for _, one in best])]
    sizes, kept, ways = chosen.sizes, friction.way is not None, friction.columns.shape[1]
    least = MATTERS * float(np.ptp(trace.force))
    seen = float(np.max(np.abs(sizes[:-1]))) > least, abs(float(sizes[-1])) * way > least
    each = " and ".join(f"{size:.2g} N on the way {name}" for size, name in zip(sizes, ("in", "out"), strict=False))
    each = f"{sizes[0]:.2g} N each way" if ways == 1 else each
    texts = (
        f"the force in air follows the direction of the motion{' and stays in a rest' * kept}, by {each}, as friction "
        f"of the slide makes it{', or tissue that the needle is in from the beginning' * kept}; this is subtracted",
        f"the force in air changes by {1e-3 * sizes[-1]:+.2g} N a mm on both ways, as a cable that pulls makes it, or "
        "a soft layer that the needle touches from the beginning and that springs back; this is subtracted, also "
        "deeper in. To tell: move over the same depths in air without tissue",
    )
    found = [Finding(name, text, True) for name, text, one in zip(FOUND, texts, seen, strict=True) if one]
    if not seen[0]:
        found += unexplained
    if not any(seen):
        return trace, found
    rig, given = np.zeros((len(trace), len(RIG_FORCES))), np.zeros(len(RIG_FORCES))
    if seen[0]:
        rig[:, :ways], given[:ways] = friction.columns, sizes[:-1]
        if kept:
            rig[:, BEFORE], given[BEFORE] = friction.before, chosen.others[0]
            rig[:, SLIDE_WAY], given[SLIDE_WAY] = friction.by_way, friction.way
    if seen[1]:
        rig[:, -1], given[-1] = cable, sizes[-1]
    force = trace.force - np.delete(rig, SLIDE_WAY, axis=1) @ np.delete(given, SLIDE_WAY)
    of = slide if kept and seen[0] else None
    return replace(trace, force=force, rig=rig, rig_sizes=tuple(given.tolist()), slide=of), found


def with_friction_at_ends(trace: Trace) -> Trace:
    """The trace with the shape of friction that a rest keeps, if it has none; nothing is subtracted of it.

    Both ends of the trace may be under it, and no turn in air tells its size.
    """
    rig, slide = shapes(trace).copy(), slide_of(trace)
    if rig[:, 0].any() or not len(slide.signs):
        return trace
    friction, before = slide.kept(0.0)
    rig[:, 0] = friction + slide.signs[0] * before
    return replace(trace, rig=rig)


@dataclass(frozen=True)
class _Friction:
    """Friction of 1 N, also each way by itself."""

    columns: Array  # (n, 1) or (n, 2)
    way: float | None = None  # m, over which it rises, if a rest keeps it
    by_way: Array = field(default_factory=lambda: np.zeros(0))  # (n,) 1/m, its derivative by that
    before: Array = field(default_factory=lambda: np.zeros(0))  # (n,) what 1 N from before the first sample adds


@dataclass(frozen=True)
class _Found:
    """What stands in air: the sizes of friction and cable, those of the other columns, and what is left (n,), N.

    NaN is left where a sample does not count.
    """

    sizes: Array
    others: Array
    left: Array


def _ends(trace: Trace, deep: float) -> list[slice]:
    """The samples of both ends that are above the depth `deep`, m, where there are enough."""
    inside = np.flatnonzero(trace.depth > deep)
    if not len(inside):
        return []
    ends = [slice(0, int(inside[0])), slice(int(inside[-1]) + 1, len(trace))]
    return [end for end in ends if end.stop - end.start >= FEWEST]


def _moves_at_both(trace: Trace, ends: Sequence[slice]) -> bool:
    """Whether there are two ends, and the last one shows enough of the way of the first one to tell a cable."""
    ways = [float(np.ptp(trace.depth[end])) for end in ends]
    return len(ways) == 2 and ways[1] > BOTH * ways[0]


def _resting(trace: Trace, columns: Array, deep: float) -> _Found | None:
    """Friction that ends in a rest, and a cable (n, k), if they and noise are all above the depth `deep`, m.

    Each end has a zero of its own. The last column is that of the depth; if it, or the only friction, is not clearly
    there, it is 0. None if none is, or if more stands there.
    """
    ends = _ends(trace, deep)
    if not ends:
        return None
    own = np.zeros((len(trace), len(ends)))
    for i, end in enumerate(ends):
        own[end, i] = 1.0
    told = [any(np.ptp(column[end]) > 0 for end in ends) for column in columns.T]
    told[-1] = _moves_at_both(trace, ends)
    rows = np.concatenate([np.arange(end.start, end.stop) for end in ends])
    longest = 0.0 if trace.time is None else max(float(np.ptp(trace.time[end])) for end in ends)
    found = _solved(trace, rows, columns, own, [i for i, one in enumerate(told) if one], longest)
    several = columns.shape[1] - 1
    return None if found is None or (several > 1 and not found.sizes[:several].all()) else found


class _Keeping:
    """Friction that a rest keeps. It rises over the way with which it leaves least.

    All ways are compared at the samples that tell with each of them; their shapes are the same for every part of air.
    """

    def __init__(self, trace: Trace, slide: Slide, steps: bool) -> None:
        """steps: whether the force steps where the slide begins to move, by more than slow noise."""
        self._trace, self._slide, self._steps = trace, slide, steps
        self._cable, self._one = trace.depth - trace.depth[0], np.ones(len(trace))

    @cached_property
    def _shapes(self) -> list[tuple[Array, Array]]:
        return [self._slide.kept(over) for over in WAYS]

    @cached_property
    def _calm(self) -> NDArray[np.bool_]:
        calm = np.ones(len(self._trace), bool)
        for shape in self._shapes:
            calm &= sum(np.abs(np.diff(one, prepend=one[0])) for one in shape) < QUICK
        return calm & np.roll(calm, 1) & np.roll(calm, -1)

    def found(self, deep: float) -> tuple[_Friction, _Found] | None:
        """As _resting(), with friction that a rest keeps, and that of 1 N: both ends have one zero.

        None if it rises over more than the longest of WAYS, where the air does not tell it from a cable.
        """
        trace, ends = self._trace, _ends(self._trace, deep)
        if len(ends) < 2:
            return None
        rows = np.concatenate([np.arange(end.start, end.stop)[self._calm[end]] for end in ends])
        at = int(np.argmin([self._left(shape, rows) for shape in self._shapes]))
        if at == len(WAYS) - 1:
            return None
        finer = np.linspace(WAYS[max(at - 1, 0)], WAYS[at + 1], 2 * FINER + 1).tolist()
        over = min(finer, key=lambda one: self._left(self._slide.kept(one), rows))
        over = max(over, SHORTEST * self._slide.step)  # else a fit finds no other way
        friction, before = self._slide.kept(over)
        longest = 0.0 if trace.time is None else float(trace.time[ends[1].start] - trace.time[ends[0].stop - 1])
        told = [0, 1] if _moves_at_both(trace, ends) else [0]
        known, own = np.column_stack((friction, self._cable)), np.column_stack((before, self._one))
        found = _solved(trace, rows, known, own, told, longest)
        if found is None and self._steps:  # a drift that need not be there makes all uncertain
            found = _solved(replace(trace, time=None), rows, known, own, told, longest)
        if found is None or not found.sizes[0] > 0 or abs(found.others[0]) > ITSELF * found.sizes[0]:
            return None
        by_way = friction_of_slide(self._slide, found.sizes[0], found.others[0], over)[1][:, -1]
        return _Friction(friction[:, None], over, by_way, before), found

    def _left(self, shape: tuple[Array, Array], rows: NDArray[np.int64]) -> float:
        """What friction of this shape, a cable and a drift leave there, N, rms."""
        trace = self._trace
        since = [] if trace.time is None else [trace.time]
        known = np.column_stack([one[rows] for one in (*shape, self._cable, self._one, *since)])
        scale = np.maximum(np.abs(known).max(axis=0), 1e-300)
        return _rms(
            trace.force[rows] - known / scale @ np.linalg.lstsq(known / scale, trace.force[rows], rcond=1e-10)[0]
        )


def _least(found: Sequence[_Found]) -> int:
    """Which of them leaves least at the samples that count for all."""
    same = np.isfinite([one.left for one in found]).all(axis=0)
    return int(np.argmin([_rms(one.left[same]) for one in found]))


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _solved(
    trace: Trace, rows: NDArray[np.int64], columns: Array, own: Array, told: list[int], longest: float
) -> _Found | None:
    """The sizes of the columns (n, m) that are told and clearly there, beside columns (n, k) of their own and a drift.

    The last column is the cable's, the others are friction. longest: s, over which the drift is not even. None if more
    than noise is left at these rows.
    """
    kept = list(told)
    drift = [] if trace.time is None else [trace.time[rows] - trace.time[0]]
    while kept:
        known = np.column_stack((columns[rows][:, kept], own[rows], *drift))
        scale = np.maximum(np.abs(known).max(axis=0), 1e-300)
        found = np.linalg.lstsq(known / scale, trace.force[rows], rcond=1e-10)[0]
        left = trace.force[rows] - known / scale @ found
        noise = _noise(trace, left)
        if noise is None:
            return None
        against = [one for one, size in zip(kept, found, strict=False) if one < columns.shape[1] - 1 and size < 0]
        if against:  # the motion, so it is no friction
            kept.remove(against[0])
            continue
        error = noise * np.sqrt(np.diag(np.linalg.pinv((known / scale).T @ (known / scale))))
        if drift:  # a sensor that drifts in air does not do so evenly
            error[: len(kept)] += SLOW * abs(found[-1] / scale[-1]) * longest
        sure = np.abs(found[: len(kept)]) / np.maximum(error[: len(kept)], 1e-300)
        if (
            sure.min() > SURE
            and kept[-1] == columns.shape[1] - 1
            and not _at_both_ends(trace, rows, known, kept, noise)
        ):
            kept.pop()
            continue
        if sure.min() > SURE:
            sizes = np.zeros(columns.shape[1])
            sizes[kept] = (found / scale)[: len(kept)]
            everywhere = np.full(len(trace), np.nan)
            everywhere[rows] = left
            return _Found(sizes, (found / scale)[len(kept) :], everywhere)
        kept.pop(int(np.argmin(sure)))
    return None


def _at_both_ends(trace: Trace, rows: NDArray[np.int64], known: Array, kept: list[int], noise: float) -> bool:
    """Whether each end shows the last of the kept columns, a cable, and of the same size: a layer of tissue need not.

    known (m, k): the kept columns and the others at these rows; noise: of a sample, N. Also if the two ends cannot be
    told apart, as where a drift is known only from both.
    """
    at, scaled = len(kept) - 1, known / np.maximum(np.abs(known).max(axis=0), 1e-300)
    behind = np.where(np.arange(len(rows)) > int(np.argmax(np.diff(rows))), scaled[:, at], 0.0)
    each = np.column_stack((scaled[:, at] - behind, behind, np.delete(scaled, at, axis=1)))
    if np.linalg.cond(each) > UNCLEAR:
        return True
    inverse = np.linalg.inv(each.T @ each)
    first, last = (inverse @ (each.T @ trace.force[rows]))[:2]
    own, shared = (
        noise * np.sqrt(np.diag(inverse)[:2]),
        noise * np.sqrt(inverse[0, 0] + inverse[1, 1] - 2 * inverse[0, 1]),
    )
    there = first * last > 0 and abs(first) > EACH * own[0] and abs(last) > EACH * own[1]
    return bool(there and abs(first - last) < EACH * shared)


def _noise(trace: Trace, left: Array) -> float | None:
    """The noise of a sample, N, if that is all that is left (m,); slow noise counts as it adds up."""
    count = len(left) // BLOCK
    means = left[: count * BLOCK].reshape(count, BLOCK).mean(axis=1)
    white = max(noise_of(left), rounding(trace.force), 1e-12 * float(np.ptp(trace.force)))
    spread = white**2 / BLOCK
    if float(np.mean(means**2)) > spread * (1 + ALIKE * np.sqrt(2 / count)):
        return None
    return white

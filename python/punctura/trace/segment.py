"""Divides a trace into what happened: contact, pops, holds, reversals, insertions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from punctura.trace.air import NOISES, contact_sample, exit_sample, leaves_air
from punctura.trace.ends import begins_in_tissue, fallen
from punctura.trace.trace import Trace
from punctura.trace.turns import depth_hysteresis, noise_of, turning_points

Array = NDArray[np.float64]

FAR, SUDDEN = 0.1, 5  # of the range of the depth: a rest goes less far, but beside a jump of fewer samples
RESTLESS = 0.25  # of the range of the force: what changes by more, beside noise, is no air
AWAY = 0.8  # of the samples in air: a soft layer may begin before the contact


@dataclass(frozen=True)
class Pop:
    """A drop of the force while the needle goes in, from sample `start` to sample `end`."""

    start: int
    end: int
    depth: float  # m, where the force is greatest
    force: float  # N, before the drop
    drop: float  # N, greater than 0
    width: float  # m, how far the needle goes during the drop


@dataclass(frozen=True)
class Stroke:
    """The needle moves in one direction or rests, from sample `start` to sample `end` (exclusive)."""

    kind: Literal["in", "out", "hold"]  # which way it goes
    start: int
    end: int
    insertion: int  # 0 for the first insertion and its withdrawal


@dataclass(frozen=True)
class Segments:
    """What happens in a trace. Indices count its samples."""

    contact: int | None  # the last sample before the force leaves the air; None if the trace begins in contact
    pops: tuple[Pop, ...]  # by depth
    strokes: tuple[Stroke, ...]  # by time
    exit: int | None = None  # the first sample in air after the last withdrawal; None if the trace does not end there

    @property
    def holds(self) -> tuple[Stroke, ...]:
        """The stretches where the needle rests."""
        return tuple(stroke for stroke in self.strokes if stroke.kind == "hold")

    @property
    def reversals(self) -> tuple[int, ...]:
        """The samples where the needle changes its direction."""
        moving = [stroke for stroke in self.strokes if stroke.kind != "hold"]
        return tuple(b.start for a, b in pairwise(moving) if a.kind != b.kind)

    def air(self, force: Array) -> tuple[Array, Array]:
        """The force (n,), N, in air, well away from the tissue: before the contact, and after the last withdrawal."""
        out = len(force) if self.exit is None else self.exit
        return force[: int(AWAY * (self.contact or 0)) + 1], force[len(force) - int(AWAY * (len(force) - out)) :]

    @property
    def insertions(self) -> int:
        """How often the needle goes in."""
        return len({stroke.insertion for stroke in self.strokes if stroke.kind == "in"})


def segment(trace: Trace) -> Segments:
    """Finds contact, pops, holds, reversals and insertions of a trace."""
    strokes = _strokes(trace)
    first = way_to_tissue(trace, strokes)
    moving = [stroke for stroke in strokes if stroke.kind != "hold"]
    out = exit_sample(trace.depth, trace.force) if first and moving[-1].kind == "out" else None
    after = None if out is None else trace.force[out:]
    contact = contact_sample(trace.depth[: first.end], trace.force[: first.end], after) if first else None
    if contact is not None and out is not None and fallen(trace, contact, out) is not None and first:
        in_tissue = begins_in_tissue(trace, contact, out)
        contact = None if in_tissue else contact_sample(trace.depth[: first.end], trace.force[: first.end])
    contact = None if contact is not None and _restless(trace.force[: contact + 1], trace.force) else contact
    out = None if out is not None and _restless(trace.force[out:], trace.force) else out
    pops = [pop for pop in _pops(trace, strokes) if contact is None or pop.start > contact]
    return Segments(contact, tuple(pops), tuple(strokes), out)


def _restless(air: Array, force: Array) -> bool:
    """Whether a force (n,), N, changes by too much beside the whole one to be that of air."""
    return float(np.ptp(air)) - NOISES * noise_of(force) > RESTLESS * float(np.ptp(force))


def way_to_tissue(trace: Trace, strokes: Sequence[Stroke]) -> Stroke | None:
    """The first way in on which the force leaves the air: a needle may rest or turn before. None without a way in."""
    inward = [stroke for stroke in strokes if stroke.kind == "in"]
    height = float(np.max(np.abs(trace.force - np.median(trace.force))))
    return next((way for way in inward if leaves_air(trace.force[: way.end], height)), inward[0] if inward else None)


def _pops(trace: Trace, strokes: list[Stroke]) -> list[Pop]:
    """Drops of at least 10 % of the range of the force and of eight times the noise."""
    found: list[Pop] = []
    least = max(0.1 * float(np.ptp(trace.force)), 8 * noise_of(trace.force))
    near = 0.02 * float(np.ptp(trace.depth))
    for stroke in strokes:
        if stroke.kind != "in" or stroke.end - stroke.start < 3:
            continue
        force = trace.force[stroke.start : stroke.end]
        points = turning_points(force, least)
        for high, low in pairwise(points):
            if force[high] - force[low] > least:
                pop = _pop(trace, high + stroke.start, low + stroke.start)
                if found and found[-1].start >= stroke.start and pop.depth - found[-1].depth < near:
                    start = max(found.pop().start, pop.start, key=lambda i: trace.force[i])
                    pop = _pop(trace, start, low + stroke.start)
                found.append(pop)
    return found


def _pop(trace: Trace, high: int, low: int) -> Pop:
    """A pop ends where nine tenths of the drop are over."""
    drop = float(trace.force[high] - trace.force[low])
    end = high + int(np.argmax(trace.force[high : low + 1] <= trace.force[low] + 0.1 * drop))
    width = float(trace.depth[end] - trace.depth[high])
    return Pop(high, end, float(trace.depth[high]), float(trace.force[high]), drop, width)


def _strokes(trace: Trace) -> list[Stroke]:
    hysteresis, numbers = depth_hysteresis(trace.depth), trace.strokes
    points = turning_points(trace.depth, hysteresis)
    resting = _resting(trace)
    found: list[Stroke] = []
    for start, end in pairwise(points):
        last = end + (end == len(trace) - 1)
        rise = trace.depth[end] - trace.depth[start]
        kind: Literal["in", "out"] = "in" if rise >= 0 else "out"
        edges = [start, *(np.flatnonzero(np.diff(resting[start:last].astype(np.int8))) + start + 1).tolist(), last]
        for a, b in pairwise(edges):
            if b > a:
                stroke = Stroke("hold" if resting[a] else kind, a, b, int(numbers[a]))
                if found and found[-1].kind == stroke.kind == "hold":  # a rest may hold a small turn
                    stroke = replace(found.pop(), end=b)
                found.append(stroke)
    return found


def _resting(trace: Trace) -> NDArray[np.bool_]:
    """Where the needle moves at less than 5 % of its usual speed for at least 0.3 s. Nowhere without time."""
    if trace.time is None:
        return np.zeros(len(trace), bool)
    half = min(0.1, (trace.time[-1] - trace.time[0]) / 100)
    ahead = np.interp(trace.time + half, trace.time, trace.depth)
    behind = np.interp(trace.time - half, trace.time, trace.depth)
    speed = np.abs(ahead - behind) / (2 * half)
    moving = speed[speed > 0.1 * speed.max()]
    slow = speed < 0.05 * float(np.median(moving)) if len(moving) else np.ones(len(trace), bool)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], slow, [False])).astype(np.int8)))
    still = max(1e-3 * float(np.ptp(trace.depth)), 4 * noise_of(trace.depth))
    rests = np.zeros(len(trace), bool)
    steps = np.abs(np.diff(trace.depth))
    jumps = int(np.sum(steps > 0.1 * steps.max())) < SUDDEN
    for start, end in edges.reshape(-1, 2):
        way = float(np.ptp(trace.depth[start:end]))  # one far slower than the way back of the machine is no rest
        short = jumps or way <= max(FAR * float(np.ptp(trace.depth)), still)
        if trace.time[end - 1] - trace.time[start] >= 0.3 and short:
            moved = np.abs(trace.depth - float(np.median(trace.depth[start:end]))) > still
            ends = np.flatnonzero(moved[end:])  # the speed is averaged, so a rest is longer than `slow` says
            starts = np.flatnonzero(moved[:start])
            rests[starts[-1] + 1 if len(starts) else 0 : end + ends[0] if len(ends) else None] = True
    return rests

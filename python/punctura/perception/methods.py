"""The methods: which level comes next, from the answers so far.

A method has no randomness of its own that is not the seed's, so the answers on disk bring it back to where it was.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol as Typed

import numpy as np

from punctura.perception.protocol import Protocol
from punctura.perception.psychometric import QUEST, Array, Grid


class Method(Typed):
    """Gives the index of the next level, and takes the answer to it."""

    def next(self) -> int: ...

    def add(self, level: int, counted: int) -> None:
        """counted: whether the answer was right, "yes" or "the comparison"; of an adjustment as `course.counted`."""


class Constant:
    """The method of constant stimuli: every level as often in each block, in random order."""

    def __init__(self, protocol: Protocol, random: np.random.Generator) -> None:
        trials, levels = protocol.file.trials, len(protocol.levels)
        a_block = np.repeat(np.arange(levels), (trials.per_level or 0) // trials.blocks)
        self._order = np.concatenate([random.permutation(a_block) for _ in range(trials.blocks)])
        self._at = 0

    def next(self) -> int:
        return int(self._order[self._at])

    def add(self, level: int, counted: int) -> None:
        self._at += 1


class Staircase:
    """The weighted up-down method: C. Kaernbach, Perception & Psychophysics 49 (1991) 227.

    `down` steps towards the harder levels after a right answer (or "yes"), `up` steps back after another one. It begins
    at the easiest level.
    """

    def __init__(self, protocol: Protocol) -> None:
        self._down, self._up = protocol.file.trials.down, protocol.file.trials.up
        self._last = len(protocol.levels) - 1
        self._at = protocol.easiest
        self._harder = -1 if self._at > self._last / 2 else 1

    def next(self) -> int:
        return self._at

    def add(self, level: int, counted: int) -> None:
        step = self._down if counted else -self._up
        self._at = min(max(level + self._harder * step, 0), self._last)


class Adjustment:
    """The comparison begins at either end of the levels as often, and the answers move it until it is equal."""

    def __init__(self, protocol: Protocol, random: np.random.Generator) -> None:
        self._last, self._up = len(protocol.levels) - 1, 1 if protocol.rises else -1
        self._starts = [int(end) * self._last for end in random.permutation(protocol.file.trials.total or 0) % 2]
        self._at = self._starts.pop()

    def next(self) -> int:
        return self._at

    def add(self, level: int, counted: int) -> None:
        self._at = min(max(level + self._up * counted, 0), self._last)
        if not counted and self._starts:
            self._at = self._starts.pop()


class Quest:
    """QUEST+: the level whose answer is expected to leave the least entropy (A. B. Watson, Journal of Vision 17(3):10,
    2017), here that of the wanted parameters alone (N. Prins, Journal of Vision 13(7):3, 2013).

    Wanted are place and width, of right answers only the place. Lapses and false alarms are summed over, else they
    would cost trials. A bias towards one interval is left out: both intervals have the comparison as often.
    """

    def __init__(self, protocol: Protocol) -> None:
        shape = protocol.shape
        shape = replace(shape, bends=False, rest="" if shape.rest == "bias" else shape.rest)
        grid = Grid(shape, protocol.levels, QUEST)
        self._p: Array = grid.probability(protocol.levels)
        self._weight: Array = grid.prior
        self._wanted = QUEST.place if protocol.shape.one_sided else QUEST.place * QUEST.width

    def next(self) -> int:
        yes = (self._p * self._weight).reshape(len(self._p), self._wanted, -1).sum(axis=2)
        no = self._weight.reshape(self._wanted, -1).sum(axis=1) - yes
        # The expected entropy after the answer is that of answer and parameters together less that of the answer.
        gain = sum(_plogp(part).sum(axis=1) - _plogp(part.sum(axis=1)) for part in (yes, no))
        return int(np.argmax(gain))

    def add(self, level: int, counted: int) -> None:
        p = self._p[level]
        weight = self._weight * (p if counted else 1 - p)
        self._weight = weight / weight.sum()


def _plogp(p: Array) -> Array:
    found: Array = p * np.log(np.maximum(p, 1e-300))
    return found


def method_of(protocol: Protocol, random: np.random.Generator) -> Method:
    """The method of a protocol at its start."""
    if protocol.file.method == "constant":
        return Constant(protocol, random)
    if protocol.adjusts:
        return Adjustment(protocol, random)
    return Staircase(protocol) if protocol.file.method == "staircase" else Quest(protocol)

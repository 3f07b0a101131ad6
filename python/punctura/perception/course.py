"""The order of a session's trials: from the seed, the participant's number and the answers so far.

Nothing here has a randomness of its own that is not the seed's, so the answers on disk bring it back to where it was.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Generator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from pydantic import BaseModel, NonNegativeInt
from scipy.special import entr

from punctura.perception.protocol import Protocol, Stimulus
from punctura.perception.psychometric import QUEST, Grid
from punctura.perception.stimulus import Felt

Kind = Literal["practice", "trial", "catch"]
Method = Generator[int, int, None]  # gives the index of the next level, and gets what `counted` says of the answer
PAIRS = 2


def constant(protocol: Protocol, random: np.random.Generator) -> Method:
    """The method of constant stimuli: every level as often in each block, in random order."""
    trials, levels = protocol.file.trials, len(protocol.levels)
    a_block = np.repeat(np.arange(levels), (trials.per_level or 0) // trials.blocks)
    for level in [int(level) for _ in range(trials.blocks) for level in random.permutation(a_block)]:  # noqa: UP028
        yield level  # and takes the answer, as a list would not
    yield -1  # after the last trial


def staircase(protocol: Protocol, _: np.random.Generator) -> Method:
    """The weighted up-down method: C. Kaernbach, Perception & Psychophysics 49 (1991) 227.

    `down` steps towards the harder levels after a right answer (or "yes"), `up` steps back after another one. It begins
    at the easiest level.
    """
    trials, last, level = protocol.file.trials, len(protocol.levels) - 1, protocol.easiest
    harder = -1 if level > last / 2 else 1
    while True:
        right = yield level
        level = min(max(level + harder * (trials.down if right else -trials.up), 0), last)


def adjustment(protocol: Protocol, random: np.random.Generator) -> Method:
    """The comparison begins at either end of the levels as often, and the answers move it until it is equal."""
    last, up = len(protocol.levels) - 1, 1 if protocol.rises else -1
    for end in random.permutation(protocol.file.trials.total or 0)[::-1] % 2:
        level, move = int(end) * last, 1
        while move:
            move = yield level
            level = min(max(level + up * move, 0), last)
    yield -1  # after the last setting


def quest(protocol: Protocol, _: np.random.Generator) -> Method:
    """QUEST+: the level whose answer is expected to leave the least entropy (A. B. Watson, Journal of Vision 17(3):10,
    2017), here that of the wanted parameters alone (N. Prins, Journal of Vision 13(7):3, 2013).

    Wanted is what the report gives: the place, and the width if there is a JND. What else there is, such as lapses, is
    summed over, else it would cost trials. A bias towards one interval is left out: both intervals have the comparison
    as often.
    """
    shape = protocol.shape
    shape = replace(shape, bends=False, rest="" if shape.rest == "bias" else shape.rest)
    grid = Grid(shape, protocol.levels, QUEST)
    p, weight = grid.probability(protocol.levels), grid.prior
    wanted = QUEST.place * (QUEST.width if protocol.compares else 1)
    while True:
        yes = (p * weight).reshape(len(p), wanted, -1).sum(axis=2)
        no = weight.reshape(wanted, -1).sum(axis=1) - yes
        # The expected entropy after the answer is that of answer and parameters together less that of the answer.
        left = sum(entr(part).sum(axis=1) - entr(part.sum(axis=1)) for part in (yes, no))
        level = int(np.argmin(np.round(left, 9)))  # the last digits differ between processors, the order must not
        counted = yield level
        weight = weight * (p[level] if counted else 1 - p[level])
        weight = weight / weight.sum()


METHODS = {"constant": constant, "staircase": staircase, "quest": quest, "adjustment": adjustment}


@dataclass(frozen=True)
class Trial:
    """One trial to come. SI."""

    number: int  # from 0, practice included
    block: int  # from 0
    kind: Kind
    level: int  # index of the level; -1 for a catch trial
    shown: Stimulus
    intervals: tuple[Stimulus, ...]  # as they come
    position: int  # of `shown` among them, from 0


class Course:
    """The trials of one session, one after the other.

    The participants are counted from 0. Each group of as many as there are intervals has the same order, with `shown`
    in another interval for each of them, so over a group no interval has more of the comparisons. Of one participant
    the comparisons of each level are as often in each interval: a bias towards an interval is known from them.
    """

    def __init__(self, protocol: Protocol, participant: int) -> None:
        self.protocol = protocol
        given = protocol.file.trials
        self._group, self._turn = divmod(participant, protocol.intervals)
        random = np.random.default_rng([protocol.file.seed, self._group])
        self._method = METHODS[protocol.file.method](protocol, random)
        self._level = next(self._method)
        kinds: list[Kind] = ["trial"] * (protocol.file.scored // given.blocks)
        kinds += ["catch"] * given.catch
        self._plan: list[tuple[int, Kind]] = [(0, "practice")] * given.practice
        self._plan += [(block, kinds[i]) for block in range(given.blocks) for i in random.permutation(len(kinds))]
        self._shown: Counter[tuple[Kind, int]] = Counter()
        self.at = 0  # in the plan
        self._number = 0  # of the trial: an adjustment has several for each place of the plan

    def __len__(self) -> int:
        return len(self._plan)

    def next(self) -> Trial | None:
        """The next trial; None after the last one."""
        if self.at == len(self._plan):
            return None
        block, kind = self._plan[self.at]
        protocol = self.protocol
        level = self._level if kind == "trial" else protocol.easiest if kind == "practice" else -1
        shown = protocol.catch if kind == "catch" else protocol.stimuli[level]
        assert shown is not None
        position = 1 if protocol.adjusts else (self._position(kind, level) + self._turn) % protocol.intervals
        others = [protocol.references[level]] * protocol.intervals if protocol.references else [shown]
        others[position] = shown
        return Trial(self._number, block, kind, level, shown, tuple(others), position)

    def add(self, trial: Trial, answer: str) -> None:
        """Takes the answer to `next`."""
        hit = counted(self.protocol, trial.position, answer)
        if trial.kind == "trial":
            self._level = self._method.send(hit)
        self._shown[trial.kind, trial.level] += 1
        self._number += 1
        self.at += not (self.protocol.adjusts and hit)

    def _position(self, kind: Kind, level: int) -> int:
        """Each group of PAIRS times as many showings of a level as there are intervals has each interval as often."""
        size = PAIRS * self.protocol.intervals
        group, place = divmod(self._shown[kind, level], size)
        seeds = [self.protocol.file.seed, self._group, len(kind), level + 1, group]
        return int(np.random.default_rng(seeds).permutation(size)[place])


class Line(BaseModel, frozen=True):
    """An answered trial, as it is on disk."""

    trial: NonNegativeInt  # its number
    block: NonNegativeInt
    kind: Kind
    level: float  # of the comparison
    position: NonNegativeInt  # of the comparison among the intervals
    answer: str
    felt: tuple[Felt, ...]  # of each interval
    recordings: tuple[str, ...] = ()  # names of the files
    time: str = ""  # of the answer, ISO 8601, UTC


def line_of(trial: Trial, answer: str, felt: Sequence[Felt], recordings: Sequence[str] = (), time: str = "") -> Line:
    return Line(
        trial=trial.number, block=trial.block, kind=trial.kind, level=trial.shown.level, position=trial.position,
        answer=answer, felt=tuple(felt), recordings=tuple(recordings), time=time,
    )  # fmt: skip


def counted(protocol: Protocol, position: int, answer: str) -> int:
    """Whether an answer is the counted one: "yes", the interval of the comparison, or the right interval.

    Of an adjustment: -1 for less, 1 for more, 0 for equal. No number is a counted answer.
    """
    if protocol.adjusts:
        return {"less": -1, "more": 1}.get(answer, 0)
    return not protocol.rates and list(protocol.answers).index(answer) == position

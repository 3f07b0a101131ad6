"""The order of a session's trials: from the seed, the participant's number and the answers so far."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Literal

import numpy as np

from punctura.perception.methods import method_of
from punctura.perception.protocol import Protocol, Stimulus
from punctura.perception.stimulus import Felt
from punctura.results import JsonObject

Kind = Literal["practice", "trial", "catch"]
PAIRS = 2


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
        given, count = protocol.file.trials, protocol.intervals
        group, self._turn = divmod(participant, count)
        random = np.random.default_rng([protocol.file.seed, group])
        self._method = method_of(protocol, random)
        scored = (given.per_level or 0) * len(protocol.levels) or (given.total or 0)
        self._plan: list[tuple[int, Kind]] = [(0, "practice")] * given.practice
        for block in range(given.blocks):
            trial: Kind = "trial"
            catch: Kind = "catch"
            kinds = [trial] * (scored // given.blocks) + [catch] * given.catch
            self._plan += [(block, kinds[i]) for i in random.permutation(len(kinds))]
        self._group = group
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
        level = self._method.next() if kind == "trial" else protocol.easiest if kind == "practice" else -1
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
            self._method.add(trial.level, hit)
        self._shown[trial.kind, trial.level] += 1
        self._number += 1
        self.at += not (self.protocol.adjusts and hit)

    def _position(self, kind: Kind, level: int) -> int:
        """Each group of PAIRS times as many showings of a level as there are intervals has each interval as often."""
        size = PAIRS * self.protocol.intervals
        group, place = divmod(self._shown[kind, level], size)
        seeds = [self.protocol.file.seed, self._group, len(kind), level + 1, group]
        return int(np.random.default_rng(seeds).permutation(size)[place])


def line_of(trial: Trial, answer: str, felt: Sequence[Felt]) -> JsonObject:
    """A trial and its answer as they are on disk."""
    return {"trial": trial.number, "block": trial.block, "kind": trial.kind, "level": trial.shown.level,
            "position": trial.position, "answer": answer, "felt": [asdict(one) for one in felt]}  # fmt: skip


def counted(protocol: Protocol, position: int, answer: str) -> int:
    """Whether an answer is the counted one: "yes", the interval of the comparison, or the right interval.

    Of an adjustment: -1 for less, 1 for more, 0 for equal. No number is a counted answer.
    """
    if protocol.adjusts:
        return {"less": -1, "more": 1}.get(answer, 0)
    return not protocol.rates and list(protocol.answers).index(answer) == position

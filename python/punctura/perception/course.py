"""The order of a session's trials: from the seed, the participant's number and the answers so far."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from punctura.perception.methods import method_of
from punctura.perception.protocol import Protocol, Stimulus

Kind = Literal["practice", "trial", "catch"]


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
    in another interval for each of them, so over a group no interval has more of the comparisons.
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
        self._positions = random.permutation(np.arange(len(self._plan)) % count)
        self.at = 0

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
        position = int(self._positions[self.at] + self._turn) % protocol.intervals
        others = [protocol.references[level]] * protocol.intervals if protocol.references else [shown]
        others[position] = shown
        return Trial(self.at, block, kind, level, shown, tuple(others), position)

    def add(self, trial: Trial, answer: str) -> None:
        """Takes the answer to `next`."""
        if trial.kind == "trial":
            self._method.add(trial.level, counted(self.protocol, trial.position, answer))
        self.at += 1


def counted(protocol: Protocol, position: int, answer: str) -> bool:
    """Whether an answer is the counted one: "yes", the interval of the comparison, or the right interval."""
    return list(protocol.answers).index(answer) == position

"""The common part of all judges of limits. Each goal has one judge."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from punctura.events import Event
from punctura.exercise.stays import MOST_GAP_S
from punctura.exercise.ticks import Flags, JudgedTicks


class Moment(NamedTuple):
    tick: int
    time: float  # s


def moment(ticks: JudgedTicks, row: int) -> Moment:
    return Moment(int(ticks.tick[row]), float(ticks.time[row]))


def first_of(ticks: JudgedTicks, flags: Flags) -> Moment | None:
    return moment(ticks, int(flags.argmax())) if flags.any() else None


def by(when: Moment | None, until: Moment | None) -> bool:
    """Whether `when` exists and is not after `until`."""
    return when is not None and (until is None or when.tick <= until.tick)


class Limit:
    """A goal that holds until it is missed. It is met only if it was measured to the end."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.missed: Moment | None = None
        self.unseen: Moment | None = None  # when needed readings had been missing for too long
        self.gone: Moment | None = None  # when a needed hand was that of a page that had been silent for too long
        self.busy: Flags | None = None  # the ticks of the batch in which a measurement is open
        self.waits_for = ""  # the end of an open measurement at the last tick: "pop" or "rest"
        self._seen_at: float | None = None

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        """Takes the next ticks of the attempt and their events."""
        raise NotImplementedError

    def measured(self, until: Moment | None) -> bool:
        """Whether the readings up to `until` are enough to call it met."""
        return not by(self.unseen, until) and not by(self.gone, until)

    def state(self, until: Moment | None, complete: bool) -> str:
        """open, met, missed or not measured, at `until`. complete: nothing more will be measured."""
        if by(self.missed, until):
            return "missed"
        if not complete:
            return "open"
        return "met" if self.measured(until) else "not measured"

    def _miss(self, ticks: JudgedTicks, flags: Flags) -> None:
        if self.missed is None:
            self.missed = first_of(ticks, flags)

    def _watch(self, ticks: JudgedTicks, seen: Flags) -> None:
        """Notes missing readings. seen: the ticks that have a reading."""
        if self.unseen is not None:
            return
        times = np.where(seen, ticks.time, -np.inf)
        began = float(ticks.time[0]) if self._seen_at is None else self._seen_at
        before = np.maximum.accumulate(np.concatenate([[began], times[:-1]]))
        self.unseen = first_of(ticks, ticks.time - before > MOST_GAP_S)
        self._seen_at = float(max(before[-1], times[-1]))

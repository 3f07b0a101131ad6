"""A moment of an attempt."""

from __future__ import annotations

from typing import NamedTuple

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

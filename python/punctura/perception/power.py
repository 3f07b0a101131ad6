"""How many trials and people an interval needs, by simulated observers; and how well the intervals cover."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple

import numpy as np

from punctura.perception.analysis import analyse, person
from punctura.perception.observer import Observer, Senses, Simulation
from punctura.perception.protocol import Protocol
from punctura.perception.psychometric import LAPSES, Array
from punctura.perception.results import Estimate, Person
from punctura.progress import Report

NO_NUMBER = Estimate(np.nan, np.nan, np.nan)


class Coverage(NamedTuple):
    """Intervals of many sessions of one observer, for whom the number is known."""

    covered: float  # share of the intervals that hold the known number
    intervals: int  # how many there are
    bias: float  # mean of the numbers less what is known, as a share of it
    width: float  # mean of the intervals
    without: float  # share of the sessions, or of their levels, that gave no number


def with_trials(protocol: Protocol, trials: int) -> Protocol:
    """The protocol with about as many scored trials, and all its catch trials, in one block."""
    given, constant = protocol.file.trials, protocol.file.method == "constant"
    changed = {
        "total": None if constant else trials,
        "per_level": max(1, round(trials / len(protocol.levels))) if constant else None,
        "blocks": 1,
        "catch": given.catch * given.blocks,
    }
    file = protocol.file.model_copy(update={"trials": given.model_copy(update=changed)})
    return replace(protocol, file=file)


def coverage(
    protocol: Protocol, observer: Observer, sessions: int, seed: int, senses: Senses | None = None, vary: bool = False
) -> dict[str, Coverage]:
    """By threshold, jnd and dprime, that of each level, as far as they are known. Raises ValueError if one is outside
    the levels. vary: each session is that of another person, whose lapses are drawn as the fit expects them."""
    senses, random, file = senses or Senses(protocol), np.random.default_rng(seed), protocol.file
    lapses = random.beta(1, LAPSES, sessions) if vary else [observer.lapse] * sessions
    people = [Simulation(protocol, replace(observer, lapse=float(lapse)), senses) for lapse in lapses]
    set_equal = protocol.reference if protocol.adjusts else None  # what a setting seeks
    truth = {"threshold": [[people[0].threshold() if set_equal is None else set_equal]] * sessions}
    if protocol.compares:
        truth["jnd"] = [[people[0].jnd()]] * sessions
    if file.method == "constant" and (protocol.intervals == 2 or (protocol.intervals == 1 and protocol.catch)):
        truth["dprime"] = [[one.dprime(i) for i in range(len(protocol.levels))] for one in people]
    found = [person(protocol, "", one.run(i, seed + i)) for i, one in enumerate(people)]
    return {what: _coverage(np.array(known), [_numbers(protocol, one, what) for one in found])
            for what, known in truth.items() if np.isfinite(known).any()}  # fmt: skip


def _numbers(protocol: Protocol, one: Person, what: str) -> list[Estimate]:
    if what != "dprime":
        return [getattr(one, what) or NO_NUMBER]
    found = {each.level: each.dprime for each in one.detection}
    return [found.get(level, NO_NUMBER) for level in protocol.levels]


def _coverage(known: Array, numbers: list[list[Estimate]]) -> Coverage:
    """known: (sessions, numbers); NaN where a number is not known."""
    true = known[np.isfinite(known)]
    value, low, high = np.array(numbers)[np.isfinite(known)].T
    given, one = ~np.isnan(low), np.isfinite(value)  # an interval may have no end, and then no number in it
    wide = (high - low)[np.isfinite(high - low)]
    bias = (np.sign(true) * (value - true))[one].sum() / max(np.abs(true[one]).sum(), 1e-300)
    held, count = ((low <= true) & (true <= high))[given].sum(), int(given.sum())
    width = float(wide.sum() / max(wide.size, 1))
    return Coverage(float(held / max(count, 1)), count, float(bias), width, float(1 - given.mean()))


@dataclass(frozen=True)
class PowerRow:
    """What an experiment of this size gives."""

    trials: int  # scored, of each person
    people: int  # in the experiment
    person_width: float  # mean width of a person's interval of the threshold
    mean_width: float  # mean width of the interval of the mean of the people; NaN for one person
    without: float  # share of sessions that gave no threshold


def power(
    protocol: Protocol, observer: Observer, trials: Sequence[int], people: Sequence[int], sessions: int, seed: int,
    between: float = 0.2, report: Report = lambda share: None,
) -> list[PowerRow]:  # fmt: skip
    """sessions: simulated experiments a row. between: standard deviation of the people's Weber fraction and noise,
    as a share of the observer's."""
    senses, rows = Senses(protocol), list[PowerRow]()
    for count, crowd in product(trials, people):
        sized, found = with_trials(protocol, count), []
        for i in range(sessions):
            random, lines = np.random.default_rng([seed, count, crowd, i]), {}
            for j in range(crowd):
                factor = float(np.exp(between * random.standard_normal()))
                one = replace(observer, weber=observer.weber * factor, noise=observer.noise * factor)
                lines[f"P{j}"] = Simulation(sized, one, senses).run(j, int(random.integers(2**31)))
            found.append(analyse(sized, lines))
        own = [one.threshold for each in found for one in each.people]
        widths = _width(own), _width([each.threshold for each in found])
        rows.append(PowerRow(sized.file.scored, crowd, *widths, without=own.count(None) / len(own)))
        report(len(rows) / (len(trials) * len(people)))
    return rows


def _width(found: Sequence[Estimate | None]) -> float:
    widths = [one.high - one.low for one in found if one is not None]
    return float(np.mean(widths)) if widths else float("nan")

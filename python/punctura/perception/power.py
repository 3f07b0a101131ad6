"""How many trials and people an interval needs, by simulated observers; and how well the intervals cover."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from punctura.perception.analysis import analyse, person
from punctura.perception.observer import Observer, Senses, Simulation
from punctura.perception.protocol import Protocol
from punctura.perception.psychometric import Array
from punctura.progress import Report


@dataclass(frozen=True)
class Coverage:
    """Intervals of many sessions of one observer, for whom the number is known."""

    what: str  # threshold, jnd or dprime, the d' of each level
    without: float  # share of the sessions, or of the levels, that gave no number
    covered: float  # share of the intervals that hold the known number
    bias: float  # mean of the numbers less what is known, as a share of it
    width: float  # mean of the intervals
    trials: int  # scored, of one session


def with_trials(protocol: Protocol, trials: int) -> Protocol:
    """The protocol with about as many scored trials, in one block."""
    given = protocol.file.trials
    changed: dict[str, int | None] = {"total": trials, "per_level": None}
    if protocol.file.method == "constant":
        changed = {"per_level": max(1, round(trials / len(protocol.levels))), "total": None}
    file = protocol.file.model_copy(update={"trials": given.model_copy(update=changed | {"blocks": 1})})
    return replace(protocol, file=file)


def coverage(
    protocol: Protocol, observer: Observer, sessions: int, seed: int, senses: Senses | None = None,
    report: Report = lambda share: None,
) -> dict[str, Coverage]:  # fmt: skip
    """By threshold, jnd and dprime, where the task has one. Raises ValueError if one is outside the levels."""
    simulation = Simulation(protocol, observer, senses)
    set_equal = protocol.reference if protocol.adjusts else None  # what a setting seeks
    truth: dict[str, list[float]] = {"threshold": [simulation.threshold() if set_equal is None else set_equal]}
    if protocol.reference is not None and not protocol.adjusts:
        truth["jnd"] = [simulation.jnd()]
    planned = protocol.file.method == "constant"
    if planned and (protocol.intervals == 2 or (protocol.intervals == 1 and protocol.catch)):
        truth["dprime"] = [simulation.dprime(i) for i in range(len(protocol.levels))]
    rows: dict[str, list[tuple[float, ...]]] = {what: [] for what in truth}
    for i in range(sessions):
        one = person(protocol, "", simulation.run(i, seed + i))
        dprimes = {each.level: each.dprime for each in one.detection}
        found = {"threshold": [one.threshold], "jnd": [one.jnd], "dprime": [*map(dprimes.get, protocol.levels)]}
        for what, known in truth.items():
            pairs = zip(known, found[what], strict=True)
            rows[what] += [(true, *each) for true, each in pairs if each is not None and np.isfinite(true)]
        report((i + 1) / sessions)
    return {
        what: _coverage(what, np.array(row).reshape(-1, 4), sessions * int(np.isfinite(truth[what]).sum()), one.trials)
        for what, row in rows.items()
    }


def _coverage(what: str, rows: Array, asked: int, trials: int) -> Coverage:
    true, value, low, high = rows.T
    known = np.isfinite(value)
    bias = (np.sign(true) * (value - true))[known].sum() / np.abs(true[known]).sum() if known.any() else np.nan
    covered = float(np.mean((low <= true) & (true <= high))) if len(rows) else np.nan
    wide = (high - low)[known & np.isfinite(high - low)]
    width = float(wide.mean()) if len(wide) else np.nan
    return Coverage(what, 1 - len(rows) / max(asked, 1), covered, float(bias), width, trials)


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
    between: float = 0.2, report: Callable[[float], None] = lambda share: None,
) -> list[PowerRow]:  # fmt: skip
    """sessions: simulated experiments a row. between: standard deviation of the people's Weber fraction and noise,
    as a share of the observer's."""
    senses = Senses(protocol)
    rows = []
    for n, count in enumerate(trials):
        sized = with_trials(protocol, count)
        for k, crowd in enumerate(people):
            own, group, without = [], [], 0
            for i in range(sessions):
                random = np.random.default_rng([seed, count, crowd, i])
                lines = {}
                for j in range(crowd):
                    factor = float(np.exp(between * random.standard_normal()))
                    one = replace(observer, weber=observer.weber * factor, noise=observer.noise * factor)
                    lines[f"P{j}"] = Simulation(sized, one, senses).run(j, int(random.integers(2**31)))
                found = analyse(sized, lines)
                own += [p.threshold.high - p.threshold.low for p in found.people if p.threshold is not None]
                without += sum(p.threshold is None for p in found.people)
                if found.threshold is not None:
                    group.append(found.threshold.high - found.threshold.low)
            rows.append(
                PowerRow(
                    trials=len(sized.levels) * (sized.file.trials.per_level or 0) or (sized.file.trials.total or 0),
                    people=crowd,
                    person_width=float(np.mean(own)) if own else float("nan"),
                    mean_width=float(np.mean(group)) if group else float("nan"),
                    without=without / (sessions * crowd),
                )
            )
            report((n * len(people) + k + 1) / (len(trials) * len(people)))
    return rows

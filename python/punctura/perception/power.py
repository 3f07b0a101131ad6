"""How many trials and people an interval needs, by simulated observers; and how well the intervals cover."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from punctura.perception.analysis import analyse, person
from punctura.perception.observer import Observer, Senses, Simulation
from punctura.perception.protocol import Protocol
from punctura.progress import Report


@dataclass(frozen=True)
class Coverage:
    """Many sessions of one observer whose threshold is known."""

    sessions: int
    without: int  # sessions that gave no threshold
    truth: float
    covered: float  # share of the intervals that hold the true threshold, of those that there are
    bias: float  # mean of the estimates less the truth, as a share of the truth
    width: float  # mean width of the interval
    trials: int  # scored, of one session


def with_trials(protocol: Protocol, trials: int) -> Protocol:
    """The protocol with about as many scored trials, in one block."""
    given = protocol.file.trials
    if protocol.file.method == "constant":
        changed = {"per_level": max(1, round(trials / len(protocol.levels))), "blocks": 1}
    else:
        changed = {"total": trials, "blocks": 1}
    file = protocol.file.model_copy(update={"trials": given.model_copy(update=changed)})
    return replace(protocol, file=file)


def coverage(
    protocol: Protocol, observer: Observer, sessions: int, seed: int, senses: Senses | None = None,
    report: Report = lambda share: None,
) -> Coverage:  # fmt: skip
    """Raises ValueError if the observer's threshold is outside the levels."""
    simulation = Simulation(protocol, observer, senses)
    truth = simulation.threshold()
    found = []
    trials = 0
    for i in range(sessions):
        result = person(protocol, "", simulation.run(i, seed + i))
        trials = result.trials
        if result.threshold is not None:
            found.append(result.threshold)
        report((i + 1) / sessions)
    if not found:
        return Coverage(sessions, sessions, truth, np.nan, np.nan, np.nan, trials)
    value, low, high = np.array(found).T
    return Coverage(
        sessions=sessions,
        without=sessions - len(found),
        truth=truth,
        covered=float(np.mean((low <= truth) & (truth <= high))),
        bias=float(value.mean() / truth - 1),
        width=float((high - low).mean()),
        trials=trials,
    )


@dataclass(frozen=True)
class PowerRow:
    """What an experiment of this size gives."""

    trials: int  # scored, of each person
    people: int
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

"""Thresholds, just noticeable differences, d' and criterion, each with an interval, or the reason why there is none."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from scipy.special import betaincinv, ndtri, stdtrit  # scipy.stats takes long to import

from punctura.perception.course import counted
from punctura.perception.load import LEAST
from punctura.perception.protocol import Protocol
from punctura.perception.psychometric import Array, Belief, posterior
from punctura.results import JsonObject

LEVEL = 0.95  # of all intervals
SHARES = ((1 - LEVEL) / 2, (1 + LEVEL) / 2)
VAGUE = 0.75  # of the range of the levels: an interval of the threshold that says nothing
QUARTER = float(ndtri(0.75))
_POINTS = 400  # of each rate, for the interval of d'


class Estimate(NamedTuple):
    """A number and the ends of its 95 % interval."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Answers:
    """The answered trials of one participant, without practice: (n,) each."""

    level: Array  # as planned
    x: Array  # as felt, if the variable is a felt quantity; otherwise as planned
    counted: Array  # 1 for the counted answer; the points of a rating
    right: Array  # 1 for a right answer; NaN where none is right
    block: Array
    catch: Array  # of the catch trials: 1 for a right answer, or for a "yes"


@dataclass
class Detection:
    """Answers at one level by the theory of signal detection."""

    level: float
    trials: int
    dprime: Estimate
    criterion: Estimate | None  # of yes or no


@dataclass
class Person:
    """The result of one participant. Levels are in the unit of the protocol's variable."""

    participant: str
    trials: int
    threshold: Estimate | None = None  # the point of subjective equality, or the level of half the answers, or the
    # difference from the reference that is told with a probability half-way between guess and 1
    jnd: Estimate | None = None  # half the distance between 25 % and 75 %; for right answers the threshold itself
    weber: Estimate | None = None  # jnd / reference
    lapse: Estimate | None = None
    slope: Estimate | None = None  # of ratings: points for each unit of the variable
    reason: str = ""  # why there is no threshold
    detection: list[Detection] = field(default_factory=list)
    right_by_block: list[float | None] = field(default_factory=list)  # None: no answer of the block is right or wrong
    catch_trials: int = 0
    catch_counted: int = 0


@dataclass
class Analysis:
    """All participants, and their means with the interval of Student's t."""

    protocol: str
    unit: str
    felt: bool  # whether the function is one of the felt quantity, not of the planned level
    people: list[Person]
    threshold: Estimate | None = None
    jnd: Estimate | None = None
    weber: Estimate | None = None
    slope: Estimate | None = None
    reason: str = ""  # why there are no means


def answers_of(protocol: Protocol, lines: Sequence[Mapping[str, object]]) -> Answers:
    """The answers of a session's lines, without its header."""
    rows: list[tuple[float, ...]] = []
    catch = []
    for line in lines:
        data: JsonObject = dict(line)
        hit = float(data["answer"] if protocol.rates else counted(protocol, data["position"], data["answer"]))
        level = float(data["level"])
        right = float("nan")
        if not protocol.compares:
            right = float("nan") if protocol.rates else hit
        elif level != protocol.reference:
            right = float((hit == 1) == ((level > (protocol.reference or 0.0)) == protocol.rises))
        if data["kind"] == "catch":
            catch.append(right)
        elif data["kind"] == "trial":
            rows.append((level, _felt(protocol, data), hit, right, float(data["block"])))
    table = np.array(rows, np.float64).reshape(-1, 5)
    planned, felt, hits, rights, blocks = table.T
    return Answers(planned, felt, hits, rights, blocks, np.array(catch))


def _felt(protocol: Protocol, line: JsonObject) -> float:
    """The level as it was felt: against the reference intervals of the same trial, at the reference's level."""
    if not protocol.in_newtons:
        return float(line["level"])
    quantity = protocol.quantity
    felt = [float(one[quantity]) for one in line["felt"]]
    mine = felt.pop(int(line["position"]))
    return mine if not felt else (protocol.reference or 0.0) + mine - sum(felt) / len(felt)


def belief_of(protocol: Protocol, answers: Answers) -> Belief:
    """The posterior of the psychometric function. Needs answers of both kinds."""
    shape = protocol.shape
    x = answers.x
    if protocol.in_newtons:  # hundreds of different numbers take long, and differ by less than the noise of any hand
        step = (max(protocol.levels) - min(protocol.levels)) / 100
        x = np.round(x / step) * step
    return posterior(shape, protocol.levels, x, answers.counted)


def person(protocol: Protocol, participant: str, lines: Sequence[Mapping[str, object]]) -> Person:
    """The result of one participant. It has a reason in place of a threshold that the answers do not determine."""
    found = answers_of(protocol, lines)
    result = Person(participant, len(found.level))
    blocks = np.unique(found.block)
    result.right_by_block = [_share(found.right[found.block == block]) for block in blocks]
    result.catch_trials, result.catch_counted = len(found.catch), int(found.catch.sum())
    result.detection = _detection(protocol, found)
    result.reason = _too_little(protocol, found)
    if result.reason:
        return result
    if protocol.rates:
        result.slope = _slope(found.x, found.counted)
        return result
    belief = belief_of(protocol, found)
    grid, shape = belief.grid, protocol.shape
    outside = float(belief.weight @ ((grid.place < grid.low) | (grid.place > grid.high)))
    if outside > SHARES[0]:
        result.reason = (
            f"the threshold may lie outside the levels (probability {outside:.0%}): show levels on both sides of it"
        )
    elif np.ptp(belief.quantiles(grid.place, SHARES)) > VAGUE * grid.spread:
        result.reason = "the answers hardly depend on the level, so they do not determine a threshold"
    if result.reason:
        return result
    result.threshold = _estimate(belief, shape.level(grid.place))
    result.lapse = _estimate(belief, grid.lapse)
    if shape.one_sided:
        result.jnd = result.threshold if protocol.reference is not None else None
    elif protocol.compares:
        ends = (shape.level(grid.place + sign * QUARTER * grid.width) for sign in (1, -1))
        result.jnd = _estimate(belief, (next(ends) - next(ends)) / 2)
    if result.jnd is not None and protocol.reference:
        result.weber = Estimate(*(one / abs(protocol.reference) for one in result.jnd))
    return result


def _share(right: Array) -> float | None:
    judged = right[np.isfinite(right)]
    return float(judged.mean()) if len(judged) else None


def _too_little(protocol: Protocol, found: Answers) -> str:
    least = LEAST[protocol.file.method]
    if len(found.level) < least:
        return f"{len(found.level)} answers are too few for a threshold: {least} are needed"
    share = float(found.counted.mean())
    if protocol.rates:
        same = [what for what, one in (("rating", found.counted), ("level", found.x)) if np.ptp(one) == 0]
        return f"every {same[0]} was the same, so there is no slope" if same else ""
    if share in (0.0, 1.0):
        what = {"yes_no": ("no", "yes")}.get(protocol.file.task, ("wrong", "right"))
        what = ("the reference", "the comparison") if protocol.compares else what
        return f"every answer was {what[int(share)]}: the levels are too easy or too hard, so there is no threshold"
    if not protocol.shape.one_sided and len(np.unique(found.level)) < 2:
        return "only one level was shown, so there is no threshold"
    return ""


def _slope(x: Array, y: Array) -> Estimate:
    """Of the straight line of least squares, with the interval of Student's t."""
    away = x - x.mean()
    slope = float(away @ y / (away @ away))
    rest = y - y.mean() - slope * away
    error = float(np.sqrt(rest @ rest / (len(x) - 2) / (away @ away)))
    half = float(stdtrit(len(x) - 2, SHARES[1])) * error
    return Estimate(slope, slope - half, slope + half)


def _estimate(belief: Belief, values: Array) -> Estimate:
    low, high = belief.quantiles(values, SHARES)
    return Estimate(belief.mean(values), float(low), float(high))


def _detection(protocol: Protocol, found: Answers) -> list[Detection]:
    """d' of each level: from yes and false alarms in the catch trials, or from two intervals with a right answer."""
    task = protocol.file.task
    if (task == "yes_no" and not len(found.catch)) or task == "three_intervals" or protocol.compares or protocol.rates:
        return []
    list_of = []
    for level in np.unique(found.level):
        here = found.counted[found.level == level]
        z_hit = _z(float(here.sum()), len(here))
        if task == "yes_no":
            z_false = _z(float(found.catch.sum()), len(found.catch))
            gap, middle = z_hit[:, None] - z_false, -(z_hit[:, None] + z_false) / 2
            list_of.append(Detection(float(level), len(here), _spread(gap.ravel()), _spread(middle.ravel())))
        else:
            list_of.append(Detection(float(level), len(here), _spread(np.sqrt(2) * z_hit), None))
    return list_of


def _z(hits: float, trials: int) -> Array:
    """Equally probable values of a rate as normal deviates: the posterior with Jeffreys' prior."""
    shares = (np.arange(_POINTS) + 0.5) / _POINTS
    rate: Array = ndtri(betaincinv(hits + 0.5, trials - hits + 0.5, shares))
    return rate


def _spread(values: Array) -> Estimate:
    return Estimate(float(values.mean()), *(float(end) for end in np.quantile(values, SHARES)))


def analyse(protocol: Protocol, sessions: Mapping[str, Sequence[Mapping[str, object]]]) -> Analysis:
    """All participants: the lines of each session by pseudonym, without headers."""
    people = [person(protocol, name, lines) for name, lines in sessions.items()]
    result = Analysis(protocol.name, protocol.unit, protocol.in_newtons, people)
    known = [one for one in people if one.threshold is not None or one.slope is not None]
    if len(known) < 2:
        what = "slope" if protocol.rates else "threshold"
        result.reason = f"{len(known)} participant{'s' * (len(known) != 1)} with a {what}: a mean needs 2"
        return result
    for key in ("threshold", "jnd", "weber", "slope"):
        values = [one.value for person in known if (one := getattr(person, key)) is not None]
        if len(values) > 1:
            setattr(result, key, _mean(np.array(values)))
    return result


def _mean(values: Array) -> Estimate:
    middle, error = float(values.mean()), float(values.std(ddof=1)) / np.sqrt(len(values))
    half = float(stdtrit(len(values) - 1, SHARES[1])) * error
    return Estimate(middle, middle - half, middle + half)

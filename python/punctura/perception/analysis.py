"""Thresholds, just noticeable differences, d' and criterion, each with an interval, or the reason why there is none."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from scipy.special import betaincinv, chdtrc, chdtri, ndtr, ndtri, stdtrit, xlogy  # scipy.stats takes long

from punctura.perception.course import Line, counted
from punctura.perception.drift import change
from punctura.perception.load import LEAST
from punctura.perception.protocol import Protocol
from punctura.perception.psychometric import QUARTER, Array, Belief, posterior
from punctura.perception.results import SHARES, Analysis, Detection, Estimate, Person

VAGUE = 0.75  # of the range of the levels: an interval of the threshold that says nothing
OPEN = 0.15  # of the largest density: that much at the end of the prior, and the answers set no bound there
MISFIT = 0.001  # probability of answers that fit the function as badly
MANY_LAPSES = 0.1  # upper end of the interval: the JND may be that of the lapses
CLEAR, LEAST_CLEAR = 2.0, 4  # widths from the threshold at which a wrong answer is a lapse; so many of such answers
REVERSED = 4.0  # standard deviations by which the answers go against the level
LEAST_CELL = 5  # answers for a rate of d'
RATE, END = 0.45, 0.2  # added to k of n for a rate, taken from none: then d' has the least bias (docs/decisions)
PRIOR = 0.8  # of each rate, a beta distribution: then the interval of d' holds nearest to 95 % (docs/decisions)
_POINTS = 200  # of each rate, for that interval
HEAD = 10  # trials: no two people feel and answer so many alike


class Answers(NamedTuple):
    """Answered trials of one participant: (n,) each."""

    level: Array  # as planned
    x: Array  # as felt, if the variable is a felt quantity; otherwise as planned
    counted: Array  # 1 for the counted answer; the points of a rating
    right: Array  # 1 for a right answer or yes, a rating, a setting; NaN where none is right
    block: Array
    side: Array  # 1: the comparison was in the first interval; -1: in another one. Of a setting: it began at the
    # highest level; at the lowest one
    reference: Array  # the level of the other intervals, felt or planned as x; NaN without one


def answers_of(protocol: Protocol, lines: Sequence[Line]) -> tuple[Answers, Answers]:
    """The trials without practice, and the catch trials."""
    rows: dict[str, list[tuple[float, ...]]] = {"trial": [], "catch": [], "practice": []}
    side = 0.0
    for line in lines:
        hit = float(line.answer if protocol.rates else counted(protocol, line.position, line.answer))
        if not protocol.adjusts:
            side = 1.0 if line.position == 0 else -1.0
        elif not side:  # the first look
            side = 1.0 if line.level == protocol.levels[-1] else -1.0
        if protocol.adjusts and hit:
            continue  # no setting yet
        felt, reference = felt_level(protocol, line)
        right = felt if protocol.adjusts else hit
        if protocol.compares:
            more = (line.level > (protocol.reference or 0.0)) == protocol.rises
            right = float("nan") if line.level == protocol.reference else float((hit == 1) == more)
        rows[line.kind].append((line.level, felt, hit, right, float(line.block), side, reference))
        side = 0.0
    trials, catch = (Answers(*np.array(rows[kind], np.float64).reshape(-1, 7).T) for kind in ("trial", "catch"))
    return trials, catch


def felt_level(protocol: Protocol, line: Line) -> tuple[float, float]:
    """The level as it was felt, against the reference intervals of the same trial, at the reference's level; and the
    level of these intervals."""
    reference = float("nan") if protocol.reference is None else protocol.reference
    if not protocol.in_newtons:
        return line.level, reference
    felt = [float(getattr(one, protocol.quantity)) for one in line.felt]
    mine = felt.pop(line.position)
    if not felt:
        return mine, reference
    return reference + mine - sum(felt) / len(felt), sum(felt) / len(felt)


def belief_of(protocol: Protocol, found: Answers, catch: Answers) -> Belief:
    """The posterior of the psychometric function. Needs answers of both kinds."""
    x, hits, side, alarms = found.x, found.counted, found.side, (0.0, 0.0)
    if protocol.file.task == "yes_no":
        alarms = float(catch.counted.sum()), float(len(catch.x))
    else:  # a catch trial is one of another level: nothing makes it clear to everybody
        x, hits, side = np.append(x, catch.x), np.append(hits, catch.counted), np.append(side, catch.side)
    if protocol.in_newtons:  # hundreds of different numbers take long: each becomes the mean of those near it
        step = (max(protocol.levels) - min(protocol.levels)) / 40
        _, group = np.unique(np.round(x / step), return_inverse=True)
        x = (np.bincount(group, x) / np.bincount(group))[group]
    return posterior(protocol.shape, protocol.levels, x, hits, side, alarms)


def person(protocol: Protocol, participant: str, lines: Sequence[Line]) -> Person:
    """The result of one participant. It has a reason in place of a threshold that the answers do not determine."""
    found, catch = answers_of(protocol, lines)
    judged = [found.right[(found.block == block) & np.isfinite(found.right)] for block in np.unique(found.block)]
    result = Person(
        participant=participant, trials=len(found.x), detection=_detection(protocol, found, catch),
        by_block=[float(right.mean()) if len(right) else None for right in judged],
        catch_trials=len(catch.x), catch_counted=int(catch.right.sum()), reason=_too_little(protocol, found),
    )  # fmt: skip
    _change(protocol, found, None, result)
    if result.reason:
        return result
    if protocol.rates:
        log = protocol.file.task == "magnitude"
        result.slope = _slope(*((np.log(one[found.x > 0]) if log else one) for one in (found.x, found.counted)))
    elif protocol.adjusts:
        result.threshold, result.jnd = _settings(protocol, found)
    else:
        belief = belief_of(protocol, found, catch)
        _change(protocol, found, belief, result)
        _fit(protocol, found, catch, belief, result)
    reference = abs(float(found.reference.mean()))
    if result.jnd and reference > 0:
        result.weber = Estimate(*(one / reference for one in result.jnd))
    return result


def _change(protocol: Protocol, found: Answers, belief: Belief | None, result: Person) -> None:
    """Over the blocks. With a method that follows the answers, those at a level depend on each other: there, all are
    compared with what the fit expects."""
    follows, p = protocol.file.method in ("staircase", "quest"), np.zeros_like(found.x)
    if follows == (belief is None) or len(np.unique(found.block)) < 2:
        return
    if belief:
        p = (belief.grid.probability(found.x, found.side) * belief.weight).sum(axis=1)

    def of(value: Array, expected: Array) -> Estimate | None:
        seen = np.isfinite(value)
        alike = [found.side] if protocol.adjusts else [found.level, found.side]
        if not belief:
            return change(value[seen], found.block[seen], [one[seen] for one in alike])
        known = expected[seen]
        return change(value[seen] - known, found.block[seen], [np.zeros_like(known)], known * (1 - known))

    result.change = of(found.right, np.where(found.right == found.counted, p, 1 - p))
    result.shift = of(found.counted, p) if protocol.compares else None


def _fit(protocol: Protocol, found: Answers, catch: Answers, belief: Belief, result: Person) -> None:
    grid, shape = belief.grid, protocol.shape
    ends = [belief.mean(np.asarray(beyond, np.float64)) for beyond in (grid.place < grid.low, grid.place > grid.high)]
    outside = sum(ends)
    flat = not shape.one_sided and belief.density(grid.width, grid.widest) > OPEN
    if _misfit(belief, found) < MISFIT:
        result.reason = "the answers do not follow one function of the level: see the share at each in trials.csv"
    elif not flat and outside > SHARES[0] and max(ends) > 3 * min(ends):
        result.reason = (
            f"the threshold may lie outside the levels (probability {outside:.0%}): show levels on both sides of it"
        )
    elif flat or outside > SHARES[0] or np.ptp(belief.quantiles(grid.place, SHARES)) > VAGUE * grid.spread:
        result.reason = "the answers hardly depend on the level, so they do not determine a threshold"
    if result.reason:
        return
    result.threshold = _estimate(belief, shape.level(grid.place))
    result.lapse = _estimate(belief, grid.lapse)
    if shape.rest == "bias":
        result.first = _estimate(belief, ndtr(grid.bias))
    if shape.one_sided:
        result.jnd = result.threshold if protocol.reference is not None else None
    elif protocol.compares:
        result.jnd = Estimate(*map(float, belief.jnd((0.5, *SHARES))))
        away = np.abs(np.append(found.x, catch.x) - result.threshold.value) * QUARTER / result.jnd.value
        lapses = result.lapse.high > MANY_LAPSES or (away > CLEAR).sum() < LEAST_CLEAR  # would look like noise
        apart = found.level != protocol.reference  # equal intervals tell the bias alone
        seen = belief if apart.all() else belief_of(protocol, Answers(*(one[apart] for one in found)), catch)
        if lapses or seen.likelihood(seen.grid.width, grid.narrowest) > OPEN:  # no answer says: not smaller still
            result.jnd = Estimate(np.nan, -np.inf, result.jnd.high)


def _misfit(belief: Belief, found: Answers) -> float:
    """The probability of answers that fit the function as badly: of the deviance of all levels."""
    cells, which = np.unique(np.column_stack([found.level, found.side]), axis=0, return_inverse=True)
    x = np.bincount(which, found.x) / np.bincount(which)
    p = (belief.grid.probability(x, cells[:, 1]) * belief.weight).sum(axis=1)[which]
    _, which = np.unique(found.level, return_inverse=True)
    n, hits, wanted = (np.bincount(which, one) for one in (np.ones_like(p), found.counted, p))
    deviance = 2 * (xlogy(hits, hits / wanted) + xlogy(n - hits, (n - hits) / (n - wanted))).sum()
    return float(chdtrc(len(n), deviance))


def _reversed(protocol: Protocol, found: Answers) -> bool:
    """Whether the answers go against the level, as if two keys were exchanged."""
    shape, hits = protocol.shape, found.counted
    if shape.one_sided:
        spread = np.sqrt(shape.guess * (1 - shape.guess) / len(hits))
        return bool(hits.mean() < shape.guess - REVERSED * spread)
    together = ((found.x - found.x.mean()) * (hits - hits.mean())).mean() * (1 if shape.rises else -1)
    return bool(together * np.sqrt(len(hits)) < -REVERSED * found.x.std() * hits.std())


def _too_little(protocol: Protocol, found: Answers) -> str:
    """Why there is no number, before any fit; empty if there may be one."""
    least, shown = LEAST[protocol.file.method], np.unique(found.level)
    if len(found.level) < least:
        return f"{len(found.level)} answers are too few for a threshold: {least} are needed"
    if protocol.rates:
        same = [what for what, one in (("rating", found.counted), ("level", found.x)) if np.ptp(one) == 0]
        return f"every {same[0]} was the same, so there is no slope" if same else ""
    if protocol.adjusts:
        if np.isin((protocol.levels[0], protocol.levels[-1]), shown).any():
            return "settings reach the end of the levels: show more"
        return "every setting was the same: make the steps between the levels smaller" if len(shown) < 2 else ""
    if _reversed(protocol, found):
        return "the answers go against the level: were two answers exchanged, or was the question misunderstood?"
    if np.ptp(found.counted) == 0:
        what = {"yes_no": ("no", "yes")}.get(protocol.file.task, ("wrong", "right"))
        what = ("the reference", "the comparison") if protocol.compares else what
        every = what[int(found.counted[0])]
        return f"every answer was {every}: the levels are too easy or too hard, so there is no threshold"
    if not protocol.shape.one_sided and len(shown) < 2:
        return "only one level was shown, so there is no threshold"
    return ""


def _slope(x: Array, y: Array) -> Estimate:
    """Of the straight line of least squares, with the interval of Student's t."""
    (slope, _), covariance = np.polyfit(x, y, 1, cov=True)
    half = float(stdtrit(len(x) - 2, SHARES[1]) * np.sqrt(covariance[0, 0]))
    return Estimate(float(slope), float(slope) - half, float(slope) + half)


def _settings(protocol: Protocol, found: Answers) -> tuple[Estimate, Estimate]:
    """The mean setting, and the JND: the deviation that half of the settings exceed, if they are normal.

    Those that begin high end higher, which is no noise: as many begin at either end. Settings that scatter by less than
    the steps between the levels show the steps: they tell how large the JND is at most.
    """
    begun = [some for side in (1, -1) if len(some := found.x[found.side == side])]
    free = len(found.x) - len(begun)
    jnd = QUARTER * _spread_of(begun)
    low, high = (float(np.sqrt(free / chdtri(free, share))) * jnd for share in SHARES)
    shown = [level for level in protocol.levels if found.level.min() <= level <= found.level.max()]
    half = float(np.diff(shown).max()) / 2
    return _mean(*begun), Estimate(jnd, low, high) if jnd >= half else Estimate(np.nan, -np.inf, max(high, half))


def _estimate(belief: Belief, values: Array) -> Estimate:
    """The middle: of a number whose posterior is skewed the mean is too large."""
    return Estimate(*map(float, belief.quantiles(values, (0.5, *SHARES))))


def _detection(protocol: Protocol, found: Answers, catch: Answers) -> list[Detection]:
    """d' and criterion of each level, from two rates: of yes, and of false alarms in the catch trials; or of the
    comparison in each of two intervals, so that a bias towards one of them is none of d'. Three intervals have none.
    Methods that follow the answers have none: which answers a level has would depend on them.
    """
    yes_no, result = protocol.file.task == "yes_no", list[Detection]()
    planned = protocol.file.method == "constant" and (yes_no or protocol.file.task == "two_intervals")
    for level in np.unique(found.level) if planned else ():
        here = found.level == level
        cells = [found.counted[here & (found.side == side)] for side in (1, -1)]
        if yes_no:  # the false alarms are counted as the answers "no" of a second interval
            cells[1] = 1 - catch.counted
        if min(map(len, cells)) < LEAST_CELL:
            continue
        hits, n = np.array([(cell.sum(), len(cell)) for cell in cells], np.float64).T
        dprime, criterion = detected(hits, n, 1.0 if yes_no else np.sqrt(2))
        result.append(Detection(level=level, trials=int(here.sum()), dprime=dprime, criterion=criterion))
    return result


def detected(hits: Array, n: Array, per: float) -> tuple[Estimate, Estimate]:
    """d' and criterion. hits, n (2,): of the answers that count in the first cells, of the others in the second."""
    never, always = hits == 0, hits == n
    shares = (np.arange(_POINTS) + 0.5) / _POINTS  # of the posterior of each rate
    one, other = (ndtri(betaincinv(k + PRIOR, m - k + PRIOR, shares)) for k, m in zip(hits, n, strict=True))
    first, second = map(float, ndtri((hits + RATE + END * (always * 1.0 - never)) / (n + 2 * RATE)))
    ends = always[0] or never[1], never[0] or always[1]
    return (
        _spread((first + second) / per, (one[:, None] + other) / per, any(never), any(always)),
        _spread((second - first) / 2, (other - one[:, None]) / 2, *ends),
    )


def _spread(value: float, values: Array, no_low: bool, no_high: bool) -> Estimate:
    """values: equally probable ones. A rate of 0 or 1 sets no bound on one side."""
    low, high = (float(end) for end in np.quantile(values, SHARES))
    return Estimate(value, -np.inf if no_low else low, np.inf if no_high else high)


def copies(sessions: Mapping[str, Sequence[Line]]) -> dict[str, str]:
    """The sessions that begin as an earlier one, and the name of that one."""
    first, found = dict[object, str](), dict[str, str]()
    for name, lines in sessions.items():
        head = tuple((line.level, line.position, line.answer, line.felt) for line in lines[:HEAD])
        if len(head) == HEAD and (other := first.setdefault(head, name)) != name:
            found[name] = other
    return found


def analyse(protocol: Protocol, sessions: Mapping[str, Sequence[Line]]) -> Analysis:
    """All participants: the lines of each session by pseudonym, without headers."""
    again, people = copies(sessions), list[Person]()
    for name, lines in sessions.items():
        if other := again.get(name, ""):
            reason = f"the session of {other} under another name, not counted: delete one of the two files"
            people.append(Person(participant=name, trials=0, copy_of=other, reason=reason))
        else:
            people.append(person(protocol, name, lines))
    result = Analysis(protocol=protocol.name, unit=protocol.unit, felt=protocol.in_newtons, people=people)
    known = [one for one in people if one.threshold or one.slope]
    if len(known) < 2:
        what = "slope" if protocol.rates else "threshold"
        result.reason = f"{len(known)} participant{'s' * (len(known) != 1)} with a {what}: a mean needs 2"
        return result
    for key in ("threshold", "jnd", "weber", "slope", "change", "shift"):
        setattr(result, key, mean_of([getattr(one, key) for one in known]))
    return result


def mean_of(people: Sequence[Estimate | None]) -> Estimate | None:
    """With the interval of Student's t; None if somebody has no number.

    If people are alike by chance, it is no narrower than their own intervals make it, as if people did not differ.
    """
    value, low, high = np.array([one or [np.nan] * 3 for one in people]).T
    if not np.isfinite([value, low, high]).all():
        return None
    middle, own = _mean(value), float(np.hypot.reduce(high - low)) / 2 / len(value)
    half = max(middle.high - middle.value, own)
    return Estimate(middle.value, middle.value - half, middle.value + half)


def _mean(*groups: Array) -> Estimate:
    """Of the groups' means: what differs between the groups is no noise."""
    middle, free = float(np.mean([one.mean() for one in groups])), sum(map(len, groups)) - len(groups)
    error = _spread_of(groups) * np.sqrt(sum(1 / len(one) for one in groups)) / len(groups)
    half = float(stdtrit(free, SHARES[1]) * error)
    return Estimate(middle, middle - half, middle + half)


def _spread_of(groups: Sequence[Array]) -> float:
    """The standard deviation of what differs within the groups."""
    squares = sum(float(((one - one.mean()) ** 2).sum()) for one in groups)
    return float(np.sqrt(squares / (sum(map(len, groups)) - len(groups))))

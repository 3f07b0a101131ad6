"""Which level comes next: constant stimuli, the weighted up-down staircase, QUEST+, adjustment."""

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from protocols import ADJUST, COMPARES, RIGHT, YES, line, written
from punctura.perception import Observer, Protocol, Simulation, load_protocol
from punctura.perception.analysis import person
from punctura.perception.course import Course, Trial, quest, staircase
from punctura.perception.power import with_trials
from punctura.perception.psychometric import QUEST, Grid
from punctura.perception.results import words


@pytest.fixture(scope="module")
def load(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Protocol]:
    return lambda text: load_protocol(written(tmp_path_factory.mktemp("protocol"), text))


def trials(protocol: Protocol, participant: int, answer: str) -> list[Trial]:
    course, found = Course(protocol, participant), []
    while (trial := course.next()) is not None:
        found.append(trial)
        course.add(trial, answer)
    return found


def test_levels_and_intervals_are_balanced_and_of_two_people_mirrored(load: Callable[[str], Protocol]) -> None:
    protocol = load(COMPARES)
    found = trials(protocol, 0, "first")
    assert Counter((one.block, one.level) for one in found) == dict.fromkeys(np.ndindex(2, 6), 10)
    orders = [[(one.level, one.position) for one in trials(protocol, i, "first")] for i in range(3)]
    assert orders[1] == [(level, 1 - position) for level, position in orders[0]] and orders[2] != orders[0]
    assert set(Counter(orders[0]).values()) == {10}  # of 20 trials a level


def test_catch_and_practice_trials_are_where_they_belong(load: Callable[[str], Protocol]) -> None:
    found = trials(load(YES), 0, "no")
    kinds = [one.kind for one in found]
    assert kinds[:2] == ["practice"] * 2 and Counter(kinds) == {"practice": 2, "trial": 120, "catch": 30}
    assert [one.level for one in found[:2]] == [0, 0]  # the thinnest wall pops most
    assert kinds[2:32] != sorted(kinds[2:32])  # among the others


def test_a_staircase_stays_where_three_of_four_answers_are_right(load: Callable[[str], Protocol]) -> None:
    """Kaernbach: up 3, down 1 converge to 75 %, where a step down is as probable as three up."""
    random = np.random.default_rng(1)
    chances = np.linspace(0.55, 0.99, 8)  # of a right answer at each level
    method, seen = staircase(load(RIGHT), random), []
    level = next(method)
    assert level == 7
    for _ in range(4000):
        seen.append(bool(random.random() < chances[level]))
        level = method.send(seen[-1])
    assert np.mean(seen[100:]) == pytest.approx(0.75, abs=0.02)


@pytest.mark.parametrize(
    "text", [RIGHT, YES.replace('"constant"', '"quest"').replace("per_level", "total")], ids=["right", "yes"]
)
def test_quest_takes_the_level_of_the_least_expected_entropy(load: Callable[[str], Protocol], text: str) -> None:
    """Against a direct sum over both answers, after some of them: the entropy of the place, whatever the rest is."""
    protocol = load(text)
    grid = Grid(replace(protocol.shape, bends=False), protocol.levels, QUEST)
    p, weight = grid.probability(protocol.levels), grid.prior
    method = quest(protocol, np.random.default_rng())
    level = next(method)
    places = np.unique(grid.place)
    for counted in (True, True, False, True, False):
        entropies = np.zeros(len(p))
        for i, row in enumerate(p):
            for chance in (row, 1 - row):
                mass = float(chance @ weight)
                after = np.array([(chance * weight)[grid.place == place].sum() for place in places]) / mass
                entropies[i] -= mass * float(after @ np.log(np.maximum(after, 1e-300)))
        assert entropies[level] == pytest.approx(min(entropies), abs=1e-9)
        weight = weight * (p[level] if counted else 1 - p[level])
        weight /= weight.sum()
        level = method.send(counted)


def test_an_adjustment_ends_where_both_intervals_seem_equal(load: Callable[[str], Protocol]) -> None:
    protocol = load(ADJUST)
    session = Simulation(protocol, Observer(weber=0.06)).run(0, 3)
    found, levels = person(protocol, "", session), [one.level for one in session if one.answer == "equal"]
    assert found.trials == len(levels) == 12 and found.threshold is not None and found.jnd is not None
    starts = [session[0], *(one for before, one in pairwise(session) if before.answer == "equal")]
    assert sorted(one.level for one in starts) == [0.14] * 6 + [0.68] * 6
    assert found.threshold.low < 0.41 < found.threshold.high and found.threshold.value == pytest.approx(np.mean(levels))
    high, low = (
        np.array([to for one, to in zip(starts, levels, strict=True) if one.level == end]) for end in (0.68, 0.14)
    )
    assert high.mean() > low.mean() + 0.02  # a setting ends nearer to where it began, which is no noise
    sd = np.sqrt((high.var(ddof=1) + low.var(ddof=1)) / 2)
    assert found.jnd.value == pytest.approx(0.67449 * sd, rel=1e-4)
    assert found.jnd.high / found.jnd.value == pytest.approx(np.sqrt(10 / 3.24697), rel=1e-4)  # chi square, 2.5 %
    half = 2.228139 * sd / np.sqrt(12)  # Student's t of 10 degrees of freedom, 97.5 %
    assert found.threshold.high - found.threshold.value == pytest.approx(half, rel=1e-5)


@pytest.mark.parametrize(("levels", "sd"), [(np.linspace(0.28, 0.32, 9), 0.04), (np.linspace(0.0, 0.6, 11), 0.02)])
def test_settings_that_the_levels_make_give_no_jnd(
    load: Callable[[str], Protocol], levels: np.ndarray, sd: float
) -> None:
    """20 settings at the level that is nearest to what a person wants; too few levels, and steps that are too wide."""
    loaded, random = load(ADJUST), np.random.default_rng(1)
    protocol = replace(loaded, stimuli=tuple(replace(loaded.stimuli[0], level=float(level)) for level in levels))
    for _ in range(20):
        wanted = random.normal(0.33 if sd < 0.03 else 0.3, sd, 20)
        nearest = levels[np.abs(levels[:, None] - wanted).argmin(axis=0)]
        found = person(protocol, "", [line(level, 1, "equal") for level in nearest])
        if sd > 0.03:
            assert found.jnd is None and found.reason == "settings reach the end of the levels: show more"
        else:
            assert found.jnd is not None and found.jnd.high > 0.67449 * sd
            assert words(found.jnd).startswith("at most 0.0") and words(found.threshold).startswith("0.3")


def test_the_slope_of_ratings_and_the_exponent_of_magnitudes(load: Callable[[str], Protocol]) -> None:
    """Against NumPy's straight line; numbers of a power of the level; no slope without two ratings."""
    text = COMPARES.replace("reference = 0.41\n", "")
    protocol = load(text.replace('"two_intervals"', '"rating"'))
    x = np.tile(protocol.levels, 20)
    y = 5 + np.arange(len(x)) % 3 + np.round(4 * (x - 0.5))
    found = person(protocol, "", [line(level, 0, f"{n:.0f}") for level, n in zip(x, y, strict=True)])
    (slope, _), covariance = np.polyfit(x, y, 1, cov=True)
    assert found.slope is not None and found.threshold is None and found.slope.value == pytest.approx(slope)
    half = 1.980272 * np.sqrt(covariance[0, 0])  # Student's t of 118 degrees of freedom, 97.5 %
    assert found.slope.high - found.slope.value == pytest.approx(half, rel=1e-5)
    same = person(protocol, "", [line(level, 0, "5") for level in x])
    assert same.slope is None and same.reason == "every rating was the same, so there is no slope"
    protocol = load(text.replace('"two_intervals"', '"magnitude"'))
    found = person(protocol, "", [line(level, 0, f"{30 * level**0.8:.6g}") for level in x])
    assert found.slope is not None and found.slope == pytest.approx((0.8, 0.8, 0.8), rel=1e-4)


def test_the_order_is_that_of_the_seed(load: Callable[[str], Protocol]) -> None:
    protocol = load(COMPARES)
    assert load(COMPARES).digest == protocol.digest
    assert load(COMPARES.replace("seed = 3", "seed = 4")).digest != protocol.digest
    assert with_trials(protocol, 240).file.trials.per_level == 40
    assert with_trials(load_protocol("wall-thickness"), 160).file.trials.catch == 40
    quest = replace(protocol, file=protocol.file.model_copy(update={"method": "quest"}))
    assert len(Course(with_trials(quest, 50), 0)) == 50

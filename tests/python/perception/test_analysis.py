"""Thresholds of observers that are known, and no number that the answers do not determine."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from protocols import COMPARES, RIGHT, SOLVED, YES, line, with_levels, written
from punctura.perception import Estimate, Observer, Protocol, Simulation, analyse, coverage, load_protocol
from punctura.perception.analysis import mean_of, person
from punctura.perception.course import Course, Kind, Line
from punctura.perception.observer import Senses
from punctura.perception.power import power, with_trials
from punctura.perception.psychometric import Shape, posterior
from punctura.perception.report import _text
from punctura.perception.results import Analysis, Person, words
from scipy.optimize import minimize
from scipy.special import ndtr, ndtri

SHARP = Observer(weber=0.06)
TEXTS = {"compares": COMPARES, "right": RIGHT, "yes": YES}


@pytest.fixture(scope="module")
def senses(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Senses]:
    """Of each protocol: computed once."""
    folder = tmp_path_factory.mktemp("protocols")
    return {name: Senses(load_protocol(written(folder, text))) for name, text in TEXTS.items()}


def session(protocol: Protocol, counted: Callable[[float, int], object]) -> list[Line]:
    """Constant stimuli whose counted answers are those of a function of level and trial."""
    names = list(protocol.answers)
    return [
        line(level, i % protocol.intervals, names[(i % protocol.intervals) ^ (not counted(level, i))])
        for i in range(20)
        for level in protocol.levels
    ]


def test_the_posterior_agrees_with_the_largest_likelihood() -> None:
    """An independent fit of the same function, without a prior: near with many answers."""
    shape, levels = Shape(), np.linspace(-1.0, 1.0, 9)
    shown = np.repeat(levels, 400)
    hits = np.random.default_rng(2).random(len(shown)) < 0.03 * 0.5 + 0.97 * ndtr((shown - 0.1) / 0.3)

    def loss(values: np.ndarray) -> float:
        p = values[2] / 2 + (1 - values[2]) * ndtr((shown - values[0]) / values[1])
        return -float(np.log(np.where(hits, p, 1 - p)).sum())

    best = minimize(loss, [0.0, 0.5, 0.05], bounds=[(-1, 1), (0.01, 3), (1e-4, 0.3)]).x
    belief = posterior(shape, levels, shown, hits)
    assert belief.mean(belief.grid.place) == pytest.approx(best[0], abs=0.005)
    assert belief.mean(belief.grid.width) == pytest.approx(best[1], rel=0.05)
    low, high = belief.quantiles(belief.grid.place, (0.025, 0.975))
    assert low < 0.1 < high and high - low < 0.06


def test_the_prior_moves_no_threshold_of_right_answers() -> None:
    """Of an observer with constant noise: 60 answers a level, shared out as the function is."""
    levels = np.geomspace(0.005, 0.64, 8)
    p = np.repeat(0.01 + 0.98 * ndtr(ndtri(0.75) * levels / 0.06), 60)
    belief = posterior(Shape(2, one_sided=True), levels, np.repeat(levels, 60), p)
    assert np.exp(belief.quantiles(belief.grid.place, (0.5,))) == pytest.approx(0.06, rel=0.01)


def test_noise_that_grows_with_the_level_moves_neither_threshold_nor_jnd(senses: dict[str, Senses]) -> None:
    """Of endless answers of two numbers with a noise of 10 % of each; and a d' that is no power of the level."""
    protocol, weber = senses["compares"].protocol, 0.1
    levels, reference = np.array(protocol.levels), 0.41
    p = np.repeat(0.01 + 0.98 * ndtr((levels - reference) / (weber * np.hypot(levels, reference))), 400)
    belief = posterior(protocol.shape, levels, np.repeat(levels, 400), p)
    grid, ratio = belief.grid, np.geomspace(0.5, 2, 10_001)
    low, high = np.interp([0.25, 0.75], ndtr((ratio - 1) / (weber * np.hypot(ratio, 1))), reference * ratio)
    assert belief.quantiles(grid.place, (0.5,)) == pytest.approx(reference, rel=0.004)
    assert belief.jnd((0.5,)) == pytest.approx((high - low) / 2, rel=0.015)
    shape = Shape(2, one_sided=True, rises=False, bends=True)
    p = np.repeat(ndtr(ndtri(0.75) * np.exp(2 * (0.4 / levels - 1))), 400)
    belief = posterior(shape, levels, np.repeat(levels, 400), p)
    assert np.exp(belief.quantiles(belief.grid.place, (0.5,))) == pytest.approx(0.4, rel=0.01)


@pytest.mark.parametrize(("count", "bias"), [(80, 0.37), (1000, 0.74)])
def test_many_answers_of_a_biased_person_tell_the_noise(count: int, bias: float) -> None:
    """They leave the parameters less room than a coarse grid has between two of its values."""
    levels = np.array([0.2, 0.3, 0.36, 0.46, 0.52, 0.62])
    x, side = np.repeat(levels, 2 * count), np.tile([1, -1], 6 * count)
    p = 0.01 + 0.98 * ndtr((x - 0.41) / 0.085 + side * bias)
    belief = posterior(Shape(bends=True, rest="bias"), levels, x, p, side)
    assert belief.jnd((0.5,)) == pytest.approx(0.085 * ndtri(0.75), rel=0.02)


@pytest.mark.statistics
def test_a_bias_towards_an_interval_is_told(senses: dict[str, Senses]) -> None:
    """The first interval is chosen in most of the trials whose intervals are equal."""
    biased = Simulation(senses["compares"].protocol, replace(SHARP, bias=0.02), senses["compares"])
    first = [one.value for i in range(20) if (one := person(biased.protocol, "", biased.run(i, i)).first)]
    assert np.mean(first) == pytest.approx(ndtr(0.02 / (0.06 * np.sqrt(2) * 0.318)), abs=0.05)  # reference: 0.318 N


@pytest.mark.statistics
def test_thresholds_in_newtons_are_those_of_what_was_felt(tmp_path: Path) -> None:
    """Hands that feel less than was planned, and each time something else."""
    protocol = with_trials(load_protocol(written(tmp_path, SOLVED)), 120)
    senses, random = Senses(protocol, 8), np.random.default_rng(1)
    for shown in (*protocol.stimuli, protocol.references[0]):
        felt = [0.9 * shown.level + 0.02 * random.standard_normal() for _ in range(8)]
        senses.known[id(shown)] = [shown.felt.model_copy(update={"drop": drop}) for drop in felt]
    found = coverage(protocol, Observer(weber=0.08), 20, 1, senses)
    assert all(found[what].covered >= 0.8 and found[what].without <= 0.1 for what in ("threshold", "jnd"))
    assert abs(found["jnd"].bias) < 0.15
    simulation = Simulation(protocol, Observer(weber=0.08), senses)
    one = person(protocol, "", simulation.run(0, 1))
    assert one.weber is not None and one.jnd is not None
    felt_reference = np.mean([felt.drop for felt in senses(protocol.references[0])])
    assert one.weber.value == pytest.approx(one.jnd.value / felt_reference, rel=0.02)
    shape = Shape(2, one_sided=True, reference=0.3)
    assert shape.axis([0.2, 0.4]) == pytest.approx([-np.inf, np.log(0.1)])  # felt the other way round: no difference


@pytest.mark.parametrize(
    ("name", "counted", "repeats", "reason"),
    [
        ("compares", lambda level, i: i < 5 and level > 0.41, 0.25, "30 answers are too few for a threshold: 40 are"),
        ("compares", lambda level, i: True, 1, "every answer was the comparison"),
        ("compares", lambda level, i: i // 2 % 2, 1, "hardly depend on the level"),
        ("compares", lambda level, i: level > 0.6 and i % 3 == 0, 1, "outside the levels"),
        ("compares", lambda level, i: i % 4 < 2, 3, "hardly depend on the level"),
        ("compares", lambda level, i: i % 10 < (7 if level in (0.3, 0.46) else 1), 3, "do not follow one function"),
        ("compares", lambda level, i: level < 0.41, 3, "go against the level"),
        ("right", lambda level, i: i // 2 % 2, 1, "outside the levels"),  # chance at every level
        ("right", lambda level, i: i % 4 == 0, 3, "go against the level"),
    ],
)
def test_answers_that_determine_none_give_no_number(
    senses: dict[str, Senses], name: str, counted: Callable[[float, int], object], repeats: float, reason: str
) -> None:
    protocol = senses[name].protocol
    given = session(protocol, counted)
    found = person(protocol, "", given * int(repeats) or given[: int(repeats * len(given))])
    assert reason in found.reason and found.threshold is found.jnd is found.weber is None


@pytest.mark.parametrize("wrong", [{0}, {3, 9}])
def test_a_staircase_that_does_not_settle_gives_no_threshold(senses: dict[str, Senses], wrong: set[int]) -> None:
    """It walks to the hardest level, and all further answers are right."""
    file = senses["right"].protocol.file.model_copy(update={"method": "staircase"})
    course, given = Course(replace(senses["right"].protocol, file=file), 0), []
    while (trial := course.next()) is not None:
        answer = ("first", "second")[trial.position ^ (trial.number in wrong)]
        given.append(line(trial.shown.level, trial.position, answer))
        course.add(trial, answer)
    assert "outside the levels" in person(course.protocol, "", given).reason


Cells = dict[tuple[Kind, int, str], tuple[int, int]]
OTHER = {"yes": "no", "first": "second", "second": "first"}


def answered(cells: Cells, level: float = 0.001) -> list[Line]:
    """cells: kind, position of the comparison and answer; how often that answer was given, and in how many trials."""
    return [
        line(level, position, answer if i < hits else OTHER[answer], kind)
        for (kind, position, answer), (hits, total) in cells.items()
        for i in range(total)
    ]


@pytest.mark.parametrize(("name", "dprime"), [("yes", 1.0), ("compares", np.sqrt(0.5))])
def test_dprime_and_criterion(senses: dict[str, Senses], name: str, dprime: float) -> None:
    """84 % and 50 %: of hits and false alarms, or of "first" if the comparison is in the first and second interval.

    A bias towards the first interval is in the criterion; the share of right answers alone would give 0.62 for 0.71.
    """
    cells: Cells = {("trial", 0, "first"): (841, 1000), ("trial", 1, "first"): (500, 1000)}
    if name == "yes":
        cells = {("trial", 0, "yes"): (841, 1000), ("catch", 0, "yes"): (500, 1000)}
    (found,) = person(senses[name].protocol, "", answered(cells)).detection
    assert found.dprime.value == pytest.approx(dprime, abs=0.01)
    assert found.criterion.value == pytest.approx(-0.5, abs=0.01)
    assert found.dprime.low < dprime < found.dprime.high < found.dprime.low + 0.25
    always = {key: (total, total) if n == 0 else (hits, total) for n, (key, (hits, total)) in enumerate(cells.items())}
    (found,) = person(senses[name].protocol, "", answered(always)).detection
    assert found.dprime.high == np.inf and found.dprime.value > dprime and " (at least " in words(found.dprime)
    assert " (at most -" in words(found.criterion)
    assert person(senses[name].protocol, "", answered(cells)[:1004]).detection == []  # 4 answers are no rate
    if name == "compares":  # a catch trial below the reference is right if the reference is chosen
        below, clear = (line(level, 0, "second", "catch") for level in (0.0, 0.9))
        assert person(senses[name].protocol, "", [below, clear]).catch_counted == 1


def test_answers_that_change_at_once_give_a_jnd_no_lower_bound(senses: dict[str, Senses]) -> None:
    protocol = senses["compares"].protocol
    together = analyse(protocol, {"P01": session(protocol, lambda level, i: level > 0.41)})
    (found,) = together.people
    assert found.threshold is not None and 0.36 < found.threshold.low < found.threshold.high < 0.46
    assert words(Estimate(1e-17, -1.0, 1.0)) == "0 (-1 to 1)"
    assert words(found.jnd).startswith("at most 0.0") and words(found.weber).startswith("at most ")
    assert '"jnd":[null,null,0.0' in together.model_dump_json()


def test_answers_to_equal_intervals_give_a_jnd_no_lower_bound(tmp_path: Path) -> None:
    """Half of these answers are right by chance, however small the JND is."""
    protocol = load_protocol(written(tmp_path, with_levels(COMPARES, np.array([0.21, 0.31, 0.41, 0.51, 0.61]))))
    sharp = session(protocol, lambda level, i: i // 2 % 2 if level == 0.41 else level > 0.41)
    dull = session(protocol, lambda level, i: (i + 0.5) / 20 < ndtr((level - 0.41) / 0.08))
    together = analyse(protocol, {"P01": sharp, "P02": dull})
    first, second = (one.jnd for one in together.people)
    assert words(first).startswith("at most 0.0") and together.jnd is None and together.threshold is not None
    assert second is not None and second.low < 0.08 * ndtri(0.75) < second.high


def test_false_alarms_of_catch_trials_are_in_the_fit() -> None:
    shown, hits = np.repeat([1.0, 2.0, 3.0, 4.0], 20), np.tile([1, 1, 0, 1], 20)
    belief = posterior(Shape(rest="floor"), [1.0, 4.0], shown, hits, catch=(40, 100))
    low, high = belief.quantiles(belief.grid.floor, (0.025, 0.975))
    assert low < 0.4 < high < low + 0.25


@pytest.mark.parametrize(("name", "truth"), [("right", 0.2), ("compares", 0.06), ("compares", 0.1)])
def test_a_catch_trial_is_an_answer_at_its_level(senses: dict[str, Senses], name: str, truth: float) -> None:
    """At a level that is told in 84 % of the trials, its errors are no lapses; at a clear level they are.

    With many lapses, or without a clear level that shows how many, a JND is given at most.
    """
    protocol, reference = senses[name].protocol, 0.41

    def told(level: float) -> float:
        away = (level - reference) / truth
        return float(1 - 0.5 ** (1 + away**1.5) if name == "right" else ndtr(away * 0.67449))

    def cells(kind: Kind, level: float, share: float) -> list[Line]:
        hits = round(share * 200), 200
        return answered({(kind, i, answer): hits for i, answer in enumerate(protocol.answers)}, level)

    given = [one for level in protocol.levels for one in cells("trial", level, told(level))]
    doubtful = reference + truth * (1.4 if name == "right" else 1.474)  # told in 84 %
    assert told(doubtful) == pytest.approx(0.84, abs=0.005)
    for level, share, lapse in ((doubtful, told(doubtful), (0.0, 0.06)), (reference + 10 * truth, 0.9, (0.12, 0.25))):
        if truth == 0.06 and level != doubtful:
            continue  # levels at which nobody lapses, and a catch trial at which one does, are no function
        found = person(protocol, "", given + cells("catch", level, share))
        assert found.jnd is not None and found.lapse is not None and lapse[0] < found.lapse.value < lapse[1]
        if truth == 0.1:
            assert words(found.jnd).startswith("at most 0.")
        elif level == doubtful:
            assert found.jnd.value == pytest.approx(truth, rel=0.06)


def test_means_of_people_need_two(senses: dict[str, Senses]) -> None:
    one = Simulation(senses["compares"].protocol, SHARP, senses["compares"])
    sessions = {f"P{i}": one.run(i, i) for i in range(4)}
    alone = analyse(one.protocol, {"P0": sessions["P0"]})
    assert alone.threshold is None and alone.reason == "1 participant with a threshold: a mean needs 2"
    together = analyse(one.protocol, sessions)
    assert together.threshold is not None and together.reason == ""
    values = [each.threshold.value for each in together.people if each.threshold]
    assert together.threshold.value == pytest.approx(np.mean(values))
    half = 3.182446 * np.std(values, ddof=1) / 2  # Student's t of 3 degrees of freedom, 97.5 %
    assert together.threshold.high - together.threshold.value == pytest.approx(half, rel=1e-5)
    alike = mean_of([Estimate(0.4, 0.3, 0.5), Estimate(0.401, 0.3, 0.5), Estimate(0.402, 0.3, 0.5)])
    assert alike and alike.high - alike.value == pytest.approx(0.1 / np.sqrt(3))  # three of their own intervals


@pytest.mark.statistics
def test_more_trials_and_people_make_smaller_intervals(senses: dict[str, Senses]) -> None:
    rows = power(senses["compares"].protocol, SHARP, [60, 240], [2, 5], 3, 1)
    assert [(row.trials, row.people) for row in rows] == [(60, 2), (60, 5), (240, 2), (240, 5)]
    assert rows[0].person_width > 1.5 * rows[2].person_width
    assert rows[2].mean_width > 1.2 * rows[3].mean_width


def test_the_report_names_who_has_no_number_for_a_mean(tmp_path: Path) -> None:
    whole, bound = Estimate(0.4, 0.3, 0.5), Estimate(np.nan, -np.inf, 0.5)
    people = [
        Person(participant=f"P0{i}", trials=120, threshold=whole, jnd=jnd, weber=jnd)
        for i, jnd in enumerate((whole, bound, None, bound), 1)
    ]
    people[3].reason, protocol = "every answer was wrong", load_protocol(written(tmp_path, COMPARES))
    report = _text(protocol, Analysis(protocol="", unit="", felt=False, people=people, threshold=whole), False)
    said = "No mean of JND and of Weber fraction: it needs a number of everybody, and P02 and P03 have none, or only a"
    assert said in report and report.count("No mean") == 1
    people[1].jnd = people[1].weber = people[2].jnd = people[2].weber = whole
    means = Analysis(protocol="", unit="", felt=False, people=people, threshold=whole, jnd=whole, weber=whole)
    assert "No mean" not in _text(protocol, means, False)

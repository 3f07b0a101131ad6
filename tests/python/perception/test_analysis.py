"""Thresholds of observers that are known, and no number that the answers do not determine."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from protocols import COMPARES, RIGHT, YES, written
from punctura.perception import Observer, Protocol, Simulation, analyse, coverage, load_protocol
from punctura.perception.analysis import person
from punctura.perception.observer import Senses
from punctura.perception.power import power, with_trials
from punctura.perception.psychometric import Shape, posterior
from scipy.optimize import minimize
from scipy.special import ndtr

SHARP = Observer(weber=0.06)
TEXTS = {"compares": COMPARES, "right": RIGHT, "yes": YES}


@pytest.fixture(scope="module")
def senses(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Senses]:
    """Of each protocol: computed once."""
    folder = tmp_path_factory.mktemp("protocols")
    return {name: Senses(load_protocol(written(folder, text))) for name, text in TEXTS.items()}


def lines(protocol: Protocol, counted: object) -> list[dict[str, object]]:
    """A session of constant stimuli whose counted answers are those of a function of level and trial."""
    found = []
    for i in range(20):
        for level in protocol.levels:
            hit = bool(counted(level, i))  # type: ignore[operator]
            answer = list(protocol.answers)[0 if hit else 1]
            found.append({"kind": "trial", "block": 0, "level": level, "position": 0, "answer": answer, "felt": []})
    return found


def test_the_posterior_agrees_with_the_largest_likelihood() -> None:
    """An independent fit of the same function, without a prior: near with many answers."""
    shape, levels = Shape(0.5), np.linspace(-1.0, 1.0, 9)
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


@pytest.mark.parametrize("name", TEXTS)
def test_the_threshold_of_an_observer_is_found(senses: dict[str, Senses], name: str) -> None:
    """20 sessions: intervals of 95 % hold the truth 15 times or less with a probability of 0.3 %."""
    found = coverage(senses[name].protocol, SHARP, 20, 5, senses[name])
    assert found.without <= 3
    assert round(found.covered * (found.sessions - found.without)) >= 16 - found.without
    assert abs(found.bias) < 0.1


@pytest.mark.statistics
@pytest.mark.parametrize("name", ["compares", "right"])
def test_95_percent_of_the_intervals_hold_the_threshold(senses: dict[str, Senses], name: str) -> None:
    """400 sessions of constant stimuli, with the figures of docs/decisions/perception.md."""
    file = senses[name].protocol.file.model_copy(update={"method": "constant"})
    protocol = with_trials(replace(senses[name].protocol, file=file), 240)
    found = coverage(protocol, SHARP, 400, 1000, senses[name])
    assert found.without <= 4
    assert 0.93 <= found.covered <= 0.97
    assert abs(found.bias) < 0.02


def test_the_just_noticeable_difference_is_that_of_the_noise(senses: dict[str, Senses]) -> None:
    """Of both intervals together: sqrt(2) times the Weber fraction, and 0.6745 of that up to 75 %."""
    simulation = Simulation(senses["compares"].protocol, SHARP, senses["compares"])
    truth = (simulation.threshold(0.75) - simulation.threshold(0.25)) / 2
    results = [person(simulation.protocol, "", simulation.run(i, i)) for i in range(20)]
    jnds = [one.jnd for one in results if one.jnd is not None]
    assert len(jnds) == 20
    assert np.mean([one.value for one in jnds]) == pytest.approx(truth, rel=0.15)
    assert sum(one.low <= truth <= one.high for one in jnds) >= 15
    assert results[0].weber is not None and results[0].jnd is not None
    assert results[0].weber.value == pytest.approx(results[0].jnd.value / 0.41)


def test_a_bias_moves_the_point_of_subjective_equality(senses: dict[str, Senses]) -> None:
    """A comparison that is felt as stronger needs less to seem equal."""
    places = []
    for bias in (-0.03, 0.0, 0.03):
        one = Simulation(senses["compares"].protocol, Observer(weber=0.06, bias=bias), senses["compares"])
        result = person(one.protocol, "", one.run(0, 3))
        assert result.threshold is not None
        places.append(result.threshold.value)
    assert places[0] > places[1] + 0.03 and places[1] > places[2] + 0.03


def test_no_number_without_enough_answers(senses: dict[str, Senses]) -> None:
    protocol = senses["compares"].protocol
    few = person(protocol, "", lines(protocol, lambda level, i: level > 0.41)[:30])
    assert few.threshold is None and few.reason == "30 answers are too few for a threshold: 40 are needed"
    same = person(protocol, "", lines(protocol, lambda level, i: True))
    assert same.threshold is None and "every answer was the comparison" in same.reason
    flat = person(protocol, "", lines(protocol, lambda level, i: i % 2))
    assert flat.threshold is None and "hardly depend on the level" in flat.reason
    beyond = person(protocol, "", lines(protocol, lambda level, i: level > 0.6 and i % 3 == 0))
    assert beyond.threshold is None and "outside the levels" in beyond.reason
    assert flat.jnd is None and flat.weber is None
    guesser = Simulation(senses["right"].protocol, Observer(lapse=1.0), senses["right"])
    assert all(person(guesser.protocol, "", guesser.run(i, i)).threshold is None for i in range(3))


def test_a_catch_trial_below_the_reference_is_right_if_the_reference_is_chosen(senses: dict[str, Senses]) -> None:
    protocol = senses["compares"].protocol
    caught = {"kind": "catch", "block": 0, "level": 0.0, "position": 0, "answer": "second", "felt": []}
    found = person(protocol, "", [caught, caught | {"level": 0.9}])
    assert (found.catch_trials, found.catch_counted) == (2, 1)


def test_dprime_and_criterion(senses: dict[str, Senses]) -> None:
    """Two normal distributions one d' apart: 84 % hits and 50 % false alarms are d' = 1 and a criterion of -0.5."""
    protocol = senses["yes"].protocol
    session = [
        {"kind": kind, "block": 0, "level": 0.001, "position": 0, "answer": "yes" if i < hits else "no", "felt": []}
        for kind, hits in (("trial", 841), ("catch", 500))
        for i in range(1000)
    ]
    (found,) = person(protocol, "", session).detection
    assert found.dprime.value == pytest.approx(1.0, abs=0.01) and found.criterion is not None
    assert found.criterion.value == pytest.approx(-0.5, abs=0.01)
    assert found.dprime.low < 1.0 < found.dprime.high < found.dprime.low + 0.25
    without = person(protocol, "", [line | {"kind": "trial"} for line in session])
    assert without.detection == []  # no false alarms are known


def test_the_slope_of_ratings(tmp_path: Path) -> None:
    """Against NumPy's straight line, and no slope without two levels or ratings."""
    text = COMPARES.replace('"two_intervals"', '"rating"').replace("reference = 0.41\n", "")
    protocol = load_protocol(written(tmp_path, text))
    ratings = [
        line | {"answer": str(5 + (i % 3) + round(4 * (float(str(line["level"])) - 0.5)))}
        for i, line in enumerate(lines(protocol, lambda level, i: True))
    ]
    found = person(protocol, "", ratings)
    x, y = (np.array([float(str(line[key])) for line in ratings]) for key in ("level", "answer"))
    (slope, _), covariance = np.polyfit(x, y, 1, cov=True)
    assert found.slope is not None and found.threshold is None and found.slope.value == pytest.approx(slope)
    half = 1.980272 * np.sqrt(covariance[0, 0])  # Student's t of 118 degrees of freedom, 97.5 %
    assert found.slope.high - found.slope.value == pytest.approx(half, rel=1e-5)
    same = person(protocol, "", [line | {"answer": "5"} for line in ratings])
    assert same.slope is None and same.reason == "every rating was the same, so there is no slope"


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


def test_more_trials_and_people_make_smaller_intervals(senses: dict[str, Senses]) -> None:
    rows = power(senses["compares"].protocol, SHARP, [60, 240], [2, 5], 3, 1)
    assert [(row.trials, row.people) for row in rows] == [(60, 2), (60, 5), (240, 2), (240, 5)]
    assert rows[0].person_width > 1.5 * rows[2].person_width
    assert rows[2].mean_width > 1.5 * rows[3].mean_width


def test_the_order_is_that_of_the_seed(tmp_path: Path) -> None:
    protocol = load_protocol(written(tmp_path, COMPARES))
    assert load_protocol(written(tmp_path, COMPARES)).digest == protocol.digest
    assert load_protocol(written(tmp_path, COMPARES.replace("seed = 3", "seed = 4"))).digest != protocol.digest
    assert with_trials(protocol, 240).file.trials.per_level == 40

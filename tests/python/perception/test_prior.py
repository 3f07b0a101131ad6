"""How often the intervals hold if people scatter as the fit expects: those of test_coverage.py are usual ones."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from protocols import COMPARES, RIGHT, line, with_levels, written
from punctura.perception import Observer, Simulation, load_protocol
from punctura.perception.analysis import answers_of, belief_of, person
from punctura.perception.course import Course
from punctura.perception.observer import Senses
from punctura.perception.power import with_trials
from punctura.perception.psychometric import Shape, posterior
from scipy.special import ndtr, ndtri
from scipy.stats import binomtest

WIDE_FINE = with_levels(RIGHT, 0.41 + np.geomspace(0.005, 0.64, 25))
SESSIONS, SEED = 400, 111_000_000


@pytest.mark.statistics
def test_over_its_prior_95_percent_of_the_intervals_hold_the_threshold(tmp_path: Path) -> None:
    """Of right answers by staircase: thresholds, exponents of d', lapses and biases that scatter as the fit expects."""
    loaded, random, found = load_protocol(written(tmp_path, WIDE_FINE)), np.random.default_rng(SEED), []
    protocol = with_trials(replace(loaded, file=loaded.file.model_copy(update={"method": "staircase"})), 240)
    for i in range(SESSIONS):
        place, exponent = np.exp([random.uniform(np.log(0.03), np.log(0.15)), 0.5 * random.standard_normal()])
        lapse, bias, course, given = random.beta(1, 50), 0.7 * random.standard_normal(), Course(protocol, i), []
        while (trial := course.next()) is not None:
            z = ndtri(0.75) * ((trial.shown.level - 0.41) / place) ** exponent + (1 - 2 * trial.position) * bias
            right = random.random() < lapse / 2 + (1 - lapse) * ndtr(z)
            answer = ("first", "second")[trial.position ^ (not right)]
            given.append(line(trial.shown.level, trial.position, answer))
            course.add(trial, answer)
        if one := person(protocol, "", given).threshold:
            found.append((one.low < place < one.high, abs(np.log(exponent))))
    held, away = np.array(found).T
    print(f"over the prior {held.mean():.1%}, near 1 {held[away < 0.3].mean():.1%}, far {held[away > 0.8].mean():.1%}")
    assert 0.92 < held.mean() < 0.98


@pytest.mark.statistics
def test_over_its_prior_95_percent_of_the_intervals_hold_the_jnd() -> None:
    """Of two sides by constant stimuli: noises, thresholds, lapses and biases that scatter as the fit expects."""
    levels, random, found = np.array([0.2, 0.3, 0.36, 0.46, 0.52, 0.62]), np.random.default_rng(3), []
    x, side = np.repeat(levels, 40), np.tile(np.repeat([1, -1], 20), 6)
    for _ in range(SESSIONS):
        noise, place = random.uniform(0.05, 0.14), random.uniform(0.36, 0.46)
        lapse, bias = random.beta(1, 50), 0.7 * random.standard_normal()
        hits = random.random(len(x)) < lapse / 2 + (1 - lapse) * ndtr((x - place) / noise + side * bias)
        middle, low, high = posterior(Shape(bends=True, rest="bias"), levels, x, hits, side).jnd((0.5, 0.025, 0.975))
        true = ndtri(0.75) * noise
        found.append((low < true < high, np.log(middle / true), np.log(high / low) / 3.92, lapse > 0.04))
    held, error, width, lapses = np.array(found).T
    print(f"JND over the prior {held.mean():.1%}, many lapses {held[lapses == 1].mean():.1%}: "
          f"interval {width.mean():.3f}, scatter {error.std():.3f}")  # fmt: skip
    assert 0.92 < held.mean() < 0.98


@pytest.mark.statistics
def test_the_interval_of_the_jnd_holds_too_often_because_the_lapses_are_not_known(tmp_path: Path) -> None:
    """The third row of test_coverage.py, and the same fits with what they do not know: the nearest values alone."""
    loaded, observer = load_protocol(written(tmp_path, COMPARES)), Observer(weber=0.06, bias=0.02)
    protocol = with_trials(loaded, 240)
    simulation = Simulation(protocol, observer, Senses(protocol, 64))
    true, found = simulation.jnd(), dict[str, list[tuple[float, float, float]]]()
    bias = observer.bias / (observer.weber * np.sqrt(2) * protocol.judged(protocol.references[0]))
    for i in range(SESSIONS // 2):
        belief = belief_of(protocol, *answers_of(protocol, simulation.run(i, SEED + i)))
        grid = belief.grid
        parts = {"lapses": (grid.lapse, 0.02), "bias": (grid.bias, bias), "shape": (grid.bend, 0.0)}
        near = {what: np.abs(values - at) == np.abs(values - at).min() for what, (values, at) in parts.items()}
        for known in ((), ("lapses",), ("bias",), tuple(parts)):
            weight = np.prod([belief.weight, *(near[what] for what in known)], axis=0)
            middle, low, high = belief._replace(weight=weight / weight.sum()).jnd((0.5, 0.025, 0.975))
            numbers = low < true < high, np.log(middle / true), np.log(high / low) / 3.92
            found.setdefault(" and ".join(known) or "nothing", []).append(numbers)
    for what, rows in found.items():
        held, error, width = np.array(rows).T
        low, high = binomtest(int(held.sum()), len(held)).proportion_ci(method="wilson")
        print(f"{what} known: {held.mean():.1%} ({low:.1%} to {high:.1%}), interval {width.mean():.3f}, "
              f"scatter {error.std():.3f}")  # fmt: skip
        assert 0.9 < held.mean() < 0.99

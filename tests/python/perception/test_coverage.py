"""How often the intervals hold what is known, and who gets no threshold: the figures of docs/perception.md."""

from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from protocols import ADJUST, COMPARES, RIGHT, YES_N, with_levels, written
from punctura.perception import Observer, Protocol, Simulation, analyse, coverage, load_protocol
from punctura.perception.analysis import PRIOR, detected, mean_of, person
from punctura.perception.course import Line
from punctura.perception.observer import Senses
from punctura.perception.power import with_trials
from punctura.ready_protocols import protocol_files
from scipy.special import ndtr, ndtri
from scipy.stats import binom, binomtest

SHARP = Observer(weber=0.06)
FAINT = Observer(noise=0.03, criterion=0.285)
READY = {name: file.read_text() for name, file in protocol_files().items()}
WIDE = with_levels(RIGHT, 0.41 + np.geomspace(0.005, 0.64, 8))  # as without any knowledge of the threshold
WIDE_FINE = with_levels(RIGHT, 0.41 + np.geomspace(0.005, 0.64, 25))  # the same, for methods that choose
WALL_FINE = with_levels(READY["wall-thickness"], np.geomspace(0.0005, 0.008, 25))


class Row(NamedTuple):
    title: str
    protocol: str
    method: str
    trials: int
    observer: Observer
    vary: bool = True  # each session is that of another person


ROWS = [
    Row("drop, two sides, first liked", READY["pop-jnd"], "constant", 216, Observer(weber=0.1, bias=0.01)),
    Row("two sides, first liked", COMPARES, "constant", 240, Observer(weber=0.06, bias=0.02)),
    Row(
        "the same, of a person with 2 % lapses", COMPARES, "constant", 240, Observer(weber=0.06, bias=0.02), vary=False
    ),
    Row("two sides", with_levels(COMPARES, np.linspace(0.2, 0.62, 25)), "quest", 120, SHARP),
    Row("right answers", WIDE, "constant", 480, SHARP),
    Row("right answers", WIDE, "constant", 720, SHARP),
    Row("right answers", WIDE_FINE, "staircase", 240, SHARP),
    Row("right answers", WIDE_FINE, "quest", 240, SHARP),
    Row("drop, yes or no", YES_N, "constant", 240, FAINT),
    Row("drop, yes or no", YES_N, "staircase", 120, FAINT),
    Row("drop, yes or no", YES_N, "quest", 120, FAINT),
    Row("`wall-thickness`", READY["wall-thickness"], "constant", 160, Observer(noise=0.03)),
    Row("its levels finer", WALL_FINE, "quest", 80, Observer(noise=0.03)),
    Row("`chatter`", READY["chatter"], "constant", 168, Observer(weber=0.0, noise=0.0008)),
    Row("`chatter`, more answers", READY["chatter"], "constant", 448, Observer(weber=0.0, noise=0.0008)),
    Row("`shaft-masking`", READY["shaft-masking"], "quest", 80, Observer(weber=0.0, noise=0.02)),
    Row("settings", ADJUST, "adjustment", 24, Observer(weber=0.03)),
]
SESSIONS, SEED = 400, 211_000_000  # no prior and no method was chosen by sessions of these seeds


def sized(folder: Path, text: str, method: str, trials: int) -> Protocol:
    loaded = load_protocol(written(folder, text))
    return with_trials(replace(loaded, file=loaded.file.model_copy(update={"method": method})), trials)


@pytest.mark.statistics
@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.title}, {row.method}")
def test_95_percent_of_the_intervals_hold_what_is_known(tmp_path: Path, row: Row) -> None:
    """Prints the rows of the table in docs/perception.md."""
    title, text, method, trials, observer, vary = row
    protocol = sized(tmp_path, text, method, trials)
    for what, one in coverage(protocol, observer, SESSIONS, SEED, Senses(protocol, 64), vary).items():
        low, high = binomtest(round(one.covered * one.intervals), one.intervals).proportion_ci(method="wilson")
        print(f"| {title} | {method}, {trials} | {what} | {one.covered:.1%} ({low:.1%} to {high:.1%}) "
              f"| {one.bias:+.1%} | {one.width:.3g} | {one.without:.1%} |")  # fmt: skip
        assert one.covered >= 0.9


@pytest.mark.statistics
@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.title}, {row.method}")
def test_who_answers_at_random_gets_no_threshold(tmp_path: Path, row: Row) -> None:
    title, text, method, trials, observer, _ = row
    protocol = sized(tmp_path, text, method, trials)
    guesses = Simulation(protocol, replace(observer, lapse=1.0), Senses(protocol, 1))
    given = sum(person(protocol, "", guesses.run(i, SEED + i)).threshold is not None for i in range(SESSIONS))
    print(f"| {title} | {method}, {trials} | {given} of {SESSIONS} who answer at random have a threshold |")
    assert given <= 2


@pytest.mark.statistics
def test_95_percent_of_the_means_of_few_people_hold_that_of_all() -> None:
    """Prints the coverage in docs/perception.md: 400 times so many of 400 people who differ by 20 %."""
    protocol, random = load_protocol("pop-jnd"), np.random.default_rng(SEED)
    senses, people, true = Senses(protocol, 64), dict[str, list[Line]](), []
    for i in range(SESSIONS):
        one = Observer(weber=0.06 * float(np.exp(0.2 * random.standard_normal())), lapse=random.beta(1, 50))
        simulation = Simulation(protocol, one, senses)
        people[f"P{i}"] = simulation.run(i, SEED + i)
        true.append((simulation.threshold(), simulation.jnd()))
    every = analyse(protocol, people).people
    for count in (3, 5, 10):
        for what, known in zip(("threshold", "jnd"), np.mean(true, axis=0), strict=True):
            drawn = [random.choice(every, count, replace=False) for _ in range(SESSIONS)]
            some = [mean_of([getattr(one, what) for one in few]) for few in drawn]
            held = [one.low <= known <= one.high for one in some if one]
            low, high = binomtest(sum(held), len(held)).proportion_ci(method="wilson")
            print(f"{count} people, {what}: {np.mean(held):.1%} ({low:.1%} to {high:.1%}) of {len(held)} means")
            assert np.mean(held) > 0.9


@pytest.mark.parametrize("counts", [(40,), pytest.param((12, 20, 40), marks=pytest.mark.statistics)], ids=str)
def test_the_exact_coverage_of_dprime(counts: tuple[int, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    """Of all answers, each with its probability: so many trials for each rate, false alarms of 1 to 70 %, d' of 0.5 to
    4. Prints it for two priors of the rates; cases with less than half an answer of a kind to expect are left out."""
    for prior in (0.5, PRIOR):
        monkeypatch.setattr("punctura.perception.analysis.PRIOR", prior)
        cases = []
        for many in product(counts, repeat=2):
            pairs = np.array([*product(*(range(n + 1) for n in many))], np.float64)
            value, low, high = np.array([detected(pair, np.array(many, np.float64), 1.0)[0] for pair in pairs]).T
            for alarm, true in product((0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7), (0.5, 1.0, 1.5, 2.0, 3.0, 4.0)):
                rates = ndtr(ndtri(alarm) + true), 1 - alarm  # of yes, and of no in the other trials
                if min(n * min(p, 1 - p) for n, p in zip(many, rates, strict=True)) >= 0.5:
                    chance = np.prod(binom.pmf(pairs, many, rates), axis=1)
                    cases.append((chance @ ((low <= true) & (true <= high)), chance @ value / true - 1))
        held, bias = np.array(cases).T
        near = np.mean((held >= 0.93) & (held <= 0.97))
        print(
            f"Beta({prior}, {prior}): {near:.0%} of {len(held)} cases from 93 to 97 %, all from {held.min():.1%} to "
            f"{held.max():.1%}; bias below 2 % in {np.mean(np.abs(bias) < 0.02):.0%}, median {np.median(bias):+.1%}"
        )
    assert near > 0.8 and held.min() > 0.93 and np.mean(np.abs(bias) < 0.02) > 0.5

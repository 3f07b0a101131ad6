"""Answers that change from block to block: who is named, and how often somebody who does not change."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from protocols import ADJUST, COMPARES, RIGHT, YES, line, written
from punctura.perception import Observer, Simulation, analyse, load_protocol
from punctura.perception.analysis import person
from punctura.perception.course import Course, Line, line_of
from punctura.perception.drift import change, sentences
from punctura.perception.observer import Senses
from scipy.stats import binomtest

SESSIONS, SEED = 400, 111_000_000
BLOCKS = "[trials]\nblocks = 4"


def session(of: Callable[[int], Simulation], seed: int) -> list[Line]:
    """of: the observer of a block."""
    course, lines = Course(of(0).protocol, seed), list[Line]()
    while (trial := course.next()) is not None:
        answer, felt = of(trial.block).answer(trial, seed)
        lines.append(line_of(trial, answer, felt))
        course.add(trial, answer)
    return lines


def test_the_interval_is_that_of_answers_whose_blocks_are_exchanged() -> None:
    """Against 4000 permutations of the answers at each level, of which some have one answer or one block."""
    random = np.random.default_rng(1)
    level = np.repeat([1.0, 2.0, 3.0, 4.0], [30, 20, 9, 1])
    block = random.integers(0, 4, 60).astype(float)
    block[level == 3] = 2
    value = (random.random(60) < level / 4).astype(float)
    found = change(value, block, [level])
    draws = []
    for _ in range(4000):
        mixed = value.copy()
        for one in (1, 2, 3):
            mixed[level == one] = random.permutation(mixed[level == one])
        draws.append(change(mixed, block, [level]))
    assert found is not None
    assert np.std([one.value for one in draws if one]) * 1.96 == pytest.approx(found.high - found.value, rel=0.03)
    share = 0.1 * block + 0.2 * level  # a straight line in each level
    assert change(share, block, [level]) == pytest.approx((0.3, *change(share, block, [level])[1:]))
    assert change(value, np.zeros(60), [level]) is None


SMALLER = "is that of all blocks together; at the end it was most likely smaller."


@pytest.mark.parametrize(
    ("text", "first", "last", "words"),
    [
        (COMPARES, Observer(weber=0.15), Observer(weber=0.04), f"The JND {SMALLER}"),
        (COMPARES, Observer(bias=0.1), Observer(bias=-0.1), ""),  # the comparison comes first as often as second
        (RIGHT.replace("[trials]", "[trials]\nblocks = 2"), Observer(weber=0.2), Observer(weber=0.05),
         f"The threshold {SMALLER}"),
        (YES.replace("[trials]", "[trials]\nblocks = 2"), Observer(noise=0.03, criterion=0.15),
         Observer(noise=0.03, criterion=0.2), f"The threshold {SMALLER}"),
    ],
)  # fmt: skip
def test_who_changes_is_named_with_what_it_does_to_the_threshold(
    tmp_path: Path, text: str, first: Observer, last: Observer, words: str
) -> None:
    protocol = load_protocol(written(tmp_path, text))
    senses = Senses(protocol)
    of = [Simulation(protocol, one, senses) for one in (first, last)]
    found = analyse(protocol, {"P01": session(lambda block: of[block], 3), "P02": session(lambda _: of[0], 3)})
    told = sentences(protocol, found)
    assert [one.partition(":")[0] for one in told[:-1]] == ["P01"] * bool(words)
    assert not words or (told[0].endswith(words) and told[-1].startswith("Of people who do not change, about one in "))


def test_a_comparison_that_seems_larger_and_larger_moves_the_threshold(tmp_path: Path) -> None:
    protocol = load_protocol(written(tmp_path, COMPARES))
    given = [
        line(level, i % 2, ("first", "second")[i % 2 ^ (level < 0.41 - 0.08 * (i >= 20))]).model_copy(
            update={"block": i // 20}
        )
        for i in range(40)
        for level in protocol.levels
    ]
    told = sentences(protocol, analyse(protocol, {"P01": given}))
    assert 'P01: at the same levels the share of "the comparison" changed by 0.167 (' in told[-2]
    assert told[-2].endswith("most likely smaller. The JND takes the change for noise.")
    assert told[-1] == "Of people who do not change, about one in 10 is named here."


@pytest.mark.statistics
@pytest.mark.parametrize("method", ["constant", "staircase", "quest", "adjustment"])
def test_one_in_20_of_those_who_do_not_change_is_named(tmp_path: Path, method: str) -> None:
    text = ADJUST if method == "adjustment" else RIGHT.replace('"quest"', f'"{method}"').replace("[trials]", BLOCKS)
    text = text.replace("total = 120", "per_level = 16") if method == "constant" else text
    simulation = Simulation(load_protocol(written(tmp_path, text)), Observer(weber=0.06))
    found = [person(simulation.protocol, "", simulation.run(i, SEED + i)).change for i in range(SESSIONS)]
    given = [one for one in found if one]
    named = sum(not one.low <= 0 <= one.high for one in given)
    low, high = binomtest(named, len(given)).proportion_ci(method="wilson")
    print(f"{method}: {named / len(given):.1%} ({low:.1%} to {high:.1%}) of {len(given)} are named")
    assert 0.01 < named / len(given) < 0.08

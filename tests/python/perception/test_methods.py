"""Which level comes next: constant stimuli, the weighted up-down staircase, QUEST+."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from protocols import COMPARES, RIGHT, YES, written
from punctura.perception import Protocol, load_protocol
from punctura.perception.course import Course
from punctura.perception.methods import Quest, Staircase
from punctura.perception.psychometric import QUEST, Grid


@pytest.fixture(scope="module")
def right(tmp_path_factory: pytest.TempPathFactory) -> Protocol:
    return load_protocol(written(tmp_path_factory.mktemp("right"), RIGHT))


def test_constant_stimuli_show_each_level_as_often_in_each_block(tmp_path: Path) -> None:
    protocol = load_protocol(written(tmp_path, COMPARES))
    course, seen = Course(protocol, 0), Counter()
    while (trial := course.next()) is not None:
        seen[trial.block, trial.level] += 1
        course.add(trial, "first")
    assert seen == {(block, level): 10 for block in range(2) for level in range(6)}


def test_catch_and_practice_trials_are_where_they_belong(tmp_path: Path) -> None:
    protocol = load_protocol(written(tmp_path, YES))
    course, kinds = Course(protocol, 0), []
    while (trial := course.next()) is not None:
        kinds.append(trial.kind)
        if trial.kind == "practice":
            assert trial.level == 0  # the thinnest wall pops most
        course.add(trial, "no")
    assert kinds[:2] == ["practice"] * 2 and Counter(kinds) == {"practice": 2, "trial": 120, "catch": 30}
    assert kinds[2:32] != sorted(kinds[2:32])  # among the others


def test_the_interval_is_balanced_over_a_group_and_over_each_level(tmp_path: Path) -> None:
    protocol = load_protocol(written(tmp_path, COMPARES))
    orders = []
    for participant in range(4):
        course, order = Course(protocol, participant), []
        while (trial := course.next()) is not None:
            order.append((trial.level, trial.position))
            course.add(trial, "first")
        orders.append(order)
    mirrored = [(level, 1 - position) for level, position in orders[0]]
    assert orders[1] == mirrored and orders[2] != orders[0]
    assert set(Counter(orders[0]).values()) == {10}  # of 20 trials a level


def test_a_staircase_stays_where_three_of_four_answers_are_right(right: Protocol) -> None:
    """Kaernbach: up 3, down 1 converge to 75 %, where a step down is as probable as three up."""
    random = np.random.default_rng(1)
    chances = np.linspace(0.55, 0.99, 8)  # of a right answer at each level
    method, seen = Staircase(right), []
    assert method.next() == 7
    for _ in range(4000):
        level = method.next()
        seen.append(bool(random.random() < chances[level]))
        method.add(level, seen[-1])
    assert np.mean(seen[100:]) == pytest.approx(0.75, abs=0.02)


def test_quest_takes_the_level_of_the_least_expected_entropy(right: Protocol) -> None:
    """Against a direct sum over both answers, after some of them: the entropy of the place, whatever the rest is."""
    method = Quest(right)
    grid = Grid(right.shape, right.levels, QUEST)
    p, weight = grid.probability(right.levels), grid.prior
    places = np.unique(grid.place)
    for counted in (True, True, False, True, False):
        entropies = []
        for row in p:
            expected = 0.0
            for chance in (row, 1 - row):
                mass = float(chance @ weight)
                after = np.array([(chance * weight)[grid.place == place].sum() for place in places]) / mass
                expected -= mass * float(after @ np.log(np.maximum(after, 1e-300)))
            entropies.append(expected)
        level = method.next()
        assert entropies[level] == pytest.approx(min(entropies), abs=1e-9)
        method.add(level, counted)
        weight = weight * (p[level] if counted else 1 - p[level])
        weight /= weight.sum()

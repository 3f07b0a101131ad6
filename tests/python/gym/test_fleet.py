"""The Fleet: many experiments, stepped on threads, with the results and the state of single ones."""

from __future__ import annotations

import numpy as np
import punctura as pn
import pytest
from punctura._core import Fleet

SCENE = pn.load_scene("k06-fig10")
START, AXIS = (0, 3e-3, 0), (0, -1, 0)


def fleet(n: int, threads: int = 1) -> Fleet:
    made = Fleet(threads=threads)
    for i in range(n):
        made.place(i, SCENE, START, AXIS, seed=i)
    return made


def test_the_results_do_not_depend_on_other_trials_threads_or_the_size_of_a_step():
    speeds = np.linspace(0.005, 0.02, 7)
    one, many = fleet(7), fleet(7, threads=3)
    for _ in range(10):
        for _ in range(4):
            small = one.step(speeds, 40)
        large = many.step(speeds, 160)
        for name in ("force", "travel", "fault", "depth"):
            assert (small[name] == large[name]).all()
        assert (small["highest_force"] <= large["highest_force"]).all()
    assert large["highest_force"].max() > 0.3 and large["depth"].shape == (7, 1)
    alone = Fleet()
    alone.place(0, SCENE, START, AXIS, seed=3)
    for _ in range(10):
        last = alone.step([speeds[3]], 160)
    assert last["force"][0] == large["force"][3]


def test_a_trial_is_an_experiment_of_the_package():
    """A hand that rests: the same motion as that of an Experiment with a target."""
    made = fleet(1).step([0.0], 1600)
    ticks = pn.Experiment(SCENE, pn.Target(START), axis=AXIS, seed=0).run(1.0)
    assert made["travel"][0] == pytest.approx(np.dot(ticks.position[-1] - START, AXIS), abs=1e-12)


def test_a_saved_trial_continues_with_the_same_bits_and_foreign_bytes_change_nothing():
    made = fleet(2)
    made.step([0.02, 0.02], 400)
    state = made.state(1)
    first = made.step([0.01, 0.01], 300)
    made.load(1, state)
    again = made.step([0.01, 0.01], 300)
    assert again["force"][1] == first["force"][1] and again["travel"][1] == first["travel"][1]
    kept = made.state(0)
    other = Fleet()
    other.place(0, pn.load_scene("venipuncture"), START, AXIS)
    for bad in (b"", state[:-1], other.state(0)):
        with pytest.raises(ValueError, match="no state of trial 0"):
            made.load(0, bad)
    assert made.state(0) == kept


def test_wrong_calls_are_refused_and_make_no_tick():
    made = fleet(2)
    before = made.state(0)
    with pytest.raises(ValueError, match="one number for each of the 2"):
        made.step([0.0], 10)
    with pytest.raises(ValueError, match=r"speed\[1\] must be finite"):
        made.step([0.0, np.inf], 10)
    with pytest.raises(ValueError, match="ticks must be 1 or more"):
        made.step([0.0, 0.0], 0)
    with pytest.raises(IndexError, match="the next new one is trial 2, not 4"):
        made.place(4, SCENE, START, AXIS)
    with pytest.raises(IndexError, match="no trial 2"):
        made.state(2)
    assert made.state(0) == before
    empty = Fleet().step([], 5)
    assert empty["force"].shape == (0,)

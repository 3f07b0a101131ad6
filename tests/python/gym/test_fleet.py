"""The Fleet: many experiments, stepped in lanes and on threads."""

import copy
import pickle
from collections.abc import Callable

import numpy as np
import punctura as pn
import pytest
from punctura._core import Fleet
from punctura.simulation import Experiment, Target

SCENE = pn.load_scene("k06-fig10")
START, AXIS = (0, 3e-3, 0), (0, -1, 0)


def fleet(n: int, threads: int = 1, instructions: str | None = None) -> Fleet:
    made = Fleet(AXIS, threads=threads, instructions=instructions)
    for i in range(n):
        made.place(i, SCENE, START, seed=i)
    return made


def test_a_trial_is_an_experiment_of_the_package():
    """A hand that rests: the same motion as that of an Experiment with a target."""
    made = fleet(1).step([0.0], 1600)
    ticks = Experiment(SCENE, Target(START), axis=AXIS, seed=0).run(1.0)
    assert made["travel"][0] == pytest.approx(np.dot(ticks.position[-1] - START, AXIS), abs=1e-12)


def test_wrong_calls_are_refused_and_make_no_tick():
    made, undisturbed = fleet(2), fleet(2)
    with pytest.raises(ValueError, match="one number for each of the 2"):
        made.step([0.0], 10)
    with pytest.raises(ValueError, match=r"speed\[1\] must be finite"):
        made.step([0.0, np.inf], 10)
    with pytest.raises(ValueError, match="ticks must be 1 or more"):
        made.step([0.0, 0.0], 0)
    with pytest.raises(IndexError, match="the next new one is trial 2, not 4"):
        made.place(4, SCENE, START)
    with pytest.raises(pn.ConfigurationError, match="friction"):
        made.place(0, SCENE.with_values({"membrane[0].friction": -1.0}), START)
    with pytest.raises(ValueError, match="start must be a position"):
        made.place(0, SCENE, (np.nan, 0, 0))
    with pytest.raises(ValueError, match="axis"):
        Fleet((0, 0, 0))
    with pytest.raises(ValueError, match='no "sse9"'):
        Fleet(AXIS, instructions="sse9")
    first, second = made.step([0.02, 0.02], 300), undisturbed.step([0.02, 0.02], 300)
    assert (first["travel"] == second["travel"]).all() and (first["travel"] > 0).all()
    empty = Fleet(AXIS).step([], 5)
    assert empty["force"].shape == (0,)


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda made: pickle.loads(pickle.dumps(made))])
@pytest.mark.parametrize("instructions", [None, "portable"])
def test_a_copied_or_pickled_fleet_goes_on_with_the_same_bits(again: Callable[[Fleet], Fleet], instructions: str):
    speeds = np.linspace(-0.01, 0.03, 11)
    made = fleet(11, instructions=instructions)
    for _ in range(3):
        made.step(speeds, 150)
    made.place(4, SCENE, START, seed=20)
    made.step(speeds + np.where(np.arange(11) == 2, 1e4, 0), 40)  # a fault in one of them
    copied, kept = again(made), made.state
    assert copied is not made and copied.in_lanes.tolist() == made.in_lanes.tolist()
    later = [made.step(speeds, 75) for _ in range(4)]
    made.state = kept
    for one in (copied, made):
        for step in later:
            for name, column in one.step(speeds, 75).items():
                np.testing.assert_array_equal(column, step[name])
    assert later[-1]["fault"][2] != 0 and later[-1]["highest_force"].max() > 0.3


def test_a_damaged_state_of_a_fleet_changes_nothing():
    made = fleet(2)
    made.step([0.01, 0.02], 100)
    scene, start, seed, speeds, ticks, begun = made.state[0]
    for bad in (
        (scene, start, seed, [np.nan], ticks, begun),
        (scene, start, seed, speeds, [-1], begun),
        (scene, start, seed, speeds, [0.5], begun),
        (scene, (np.nan, 0, 0), seed, speeds, ticks, begun),
        (scene, start, seed, speeds, ticks, 50),
        (scene, start, seed, [0.01, 0.02], ticks, begun),
        (scene, start, seed),
        ("scene", start, seed, speeds, ticks, begun),
        (scene, start, -1, speeds, ticks, begun),
    ):
        with pytest.raises(ValueError, match="state"):
            made.state = [bad]
        assert made.size == 2
    made.state = []
    assert made.size == 0

"""No simulator loses a tick by the rounding of its times, at any start, and odd steps make the ticks that are due."""

from itertools import pairwise

import numpy as np
import punctura as pn
import pytest
from fmu_slave import INPUTS, OK, SCENE, Slave

DOWN = np.array([0.0, -1.0, 0.0])


def depths(n):
    k = np.arange(n)
    return 8e-3 * np.minimum(1, k / (0.6 * n)) - 2e-3 + 2e-4 * np.sin(0.37 * k)  # no two ticks alike


def times(how, start, step, n):
    """The pairs (time, step) that simulators give for n steps."""
    if how == "adds":
        now = start
        for _ in range(n):
            yield now, step
            now += step
        return
    grid = [start + k * step for k in range(n + 1)]
    yield from ((a, b - a if how == "subtracts" else step) for a, b in pairwise(grid))


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("start", [0.0, -7.3, 86400.0, 1.8e9])
@pytest.mark.parametrize("how", ["adds", "multiplies", "subtracts"])
def test_a_step_of_the_period_has_one_tick(tmp_path, version, start, how):
    for rate in (1000.0, 3000.0):
        if how == "adds" and start == 1.8e9 and rate != 1000.0:
            continue
        scene = pn.load_scene(SCENE).with_values({"servo.rate": rate})
        n = 15000 if how == "adds" and start == 1.8e9 else 500
        positions = depths(n)[:, None] * DOWN
        right = pn.Insertion(scene).run(positions, DOWN).force
        needle = Slave(tmp_path, version, scene).started(start)
        for k, (time, step) in enumerate(times(how, start, 1 / rate, n)):
            needle.set(INPUTS, (*positions[k], *DOWN))
            assert needle.step(time, step) == OK
            assert needle.force() == list(right[k]), (rate, k)


def test_a_simulator_that_adds_its_step_for_minutes_loses_no_tick(tmp_path):
    scene = pn.load_scene(SCENE).with_values({"servo.rate": 1000.0})
    needle, still, n = Slave(tmp_path, 3, scene).started(), 333_000, 3000
    positions = np.vstack([np.tile([0, 1e-3, 0], (still, 1)), depths(n)[:, None] * DOWN])
    right = pn.Insertion(scene).run(positions, DOWN).force
    needle.set(INPUTS, (*positions[0], *DOWN))
    for k, (time, step) in enumerate(times("adds", 0.0, 1e-3, still + n)):
        if k > still:
            needle.set(INPUTS, (*positions[k], *DOWN))
        assert needle.step(time, step) == OK
        assert k < still or needle.force() == list(right[k]), k


@pytest.mark.parametrize(("step", "ticks"), [(0.25e-3, (0, 0, 0, 1)), (0.4e-3, (0, 0, 1, 0, 1)), (2.5e-3, (2, 3))])
def test_a_step_that_is_no_multiple_of_the_period_makes_the_ticks_that_are_due(tmp_path, step, ticks):
    scene = pn.load_scene(SCENE).with_values({"servo.rate": 1000.0})
    needle, right = Slave(tmp_path, 3, scene), pn.Insertion(scene)
    needle.set([10], [False], "Boolean")  # inputs are held during a step
    needle.started()
    for k, p in enumerate(depths(600)[:, None] * DOWN):
        before = needle.force()
        needle.set(INPUTS, (*p, *DOWN))
        assert needle.step(k * step, step) == OK
        expected = before
        for _ in range(ticks[k % len(ticks)]):
            expected = list(right.step(p, DOWN))
        assert needle.force() == expected, k


@pytest.mark.parametrize("version", [2, 3])
def test_times_that_do_not_follow_each_other_are_refused_and_change_nothing(tmp_path, version):
    nan = float("nan")
    needle = Slave(tmp_path, version)
    for start, stop in ((nan, None), (float("inf"), None), (0.0, -1.0), (0.0, nan)):
        assert needle.enter(start, stop) != OK
    needle = Slave(tmp_path, version).started(5.0, 6.0)
    assert needle.step(5.0, 0.25) == OK
    for time, step in ((5.0, 0.25), (5.2, 0.25), (5.3, 0.25), (0.25, 0.25), (5.25, -0.1), (5.25, nan), (5.25, 0.8)):
        assert needle.step(time, step) != OK, (time, step)
    if version == 3:
        assert needle.log[0] == "fmi3DoStep: a step begins at 5 s, but the last one ended at 5.25 s"
        assert needle.log[-1] == "fmi3DoStep: a step to 6.05 s is beyond the end of the experiment, 6 s"
    assert needle.step(5.25, 0.75) == OK

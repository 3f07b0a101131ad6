"""Noise of the depth: it is taken out of the motion, and what is left of it reaches the intervals."""

import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from punctura.identify import Rig, identify
from punctura.identify.depth_noise import with_quiet_depth
from punctura.trace import Trace

TOOL = runpy.run_path(str(Path(__file__).parents[3] / "tools" / "try_intervals.py"))
Conditions, random_trace = TOOL["Conditions"], TOOL["random_trace"]
NOISE = 10e-6


def by_machine(seed, noise=NOISE):
    return random_trace(seed, Conditions(machine=True, depth_noise=noise))


@pytest.mark.parametrize("seed", [1, 4])
def test_noise_of_the_depth_makes_no_second_wall_and_the_spring_is_held(seed):
    trace, needle, truth = by_machine(seed)
    found = identify(trace, needle)
    assert len(found.parameters.membranes) == 1 and found.extensions == ()
    assert found.doubts.explained.ok
    spring = next(one for one in found.estimates if one.name == "coupling_stiffness")
    assert spring.low <= truth["coupling_stiffness"] <= spring.high and spring.high < 1.15 * spring.low
    (known,) = found.as_dict()["rig"]
    assert (known["name"], known["stated"]) == ("depth_noise", False)
    assert known["value"] == pytest.approx(NOISE, rel=0.15)


@pytest.mark.parametrize("tremor", [False, True])
def test_the_quiet_depth_knows_its_own_error(tremor):
    errors, expected = [], []
    for seed in range(1, 7):
        exact, _, _ = by_machine(seed, 0.0)
        if tremor:  # of a hand, 8 Hz
            shaken = exact.depth + 60e-6 * np.sin(2 * np.pi * 8 * exact.time) * np.sin(exact.time)
            exact = replace(exact, depth=shaken)
        noise = NOISE * np.random.default_rng(seed).normal(size=len(exact))
        quiet, known = with_quiet_depth(replace(exact, depth=exact.depth + noise))
        assert known == pytest.approx(NOISE, rel=0.15)
        errors.append(np.mean((quiet.depth - exact.depth) ** 2))
        expected.append(np.mean(quiet.depths.var(axis=0)))
    error = np.sqrt(np.mean(errors))
    assert error < (0.6 if tremor else 0.2) * NOISE
    assert error == pytest.approx(np.sqrt(np.mean(expected)), rel=0.3)


def test_a_motion_that_the_force_follows_is_no_noise():
    """The encoder of the simulated device has counts, and the force follows each of them."""
    trace, _, _ = random_trace(1, Conditions())
    steps = np.round(trace.depth / 25e-6)
    assert len(np.unique(steps)) < 500 and with_quiet_depth(trace) == (trace, 0.0)
    exact, _, _ = by_machine(2, 0.0)
    shaken = exact.depth + NOISE * np.random.default_rng(2).normal(size=len(exact))
    force = exact.force + 3000 * (shaken - exact.depth)
    assert with_quiet_depth(Trace(shaken, force, exact.time))[1] == 0.0


def test_uneven_samples_are_no_noise():
    """A digitised curve has no time, or time at uneven steps: its depth seems to shake."""
    trace, _, _ = by_machine(1)
    assert with_quiet_depth(replace(trace, time=None))[1] == 0.0
    uneven = np.cumsum(np.random.default_rng(1).uniform(0.2, 1.8, len(trace))) * 5e-3
    digitised = Trace(np.interp(uneven, trace.time, trace.depth), np.interp(uneven, trace.time, trace.force), uneven)
    assert with_quiet_depth(digitised)[1] == 0.0


def test_rounding_of_the_depth_is_no_noise():
    exact, _, _ = by_machine(1, 0.0)
    rounded = replace(exact, depth=np.round(exact.depth, 12), force=10 * exact.depth)
    assert with_quiet_depth(rounded)[1] == 0.0


def test_a_stated_noise_counts():
    trace, needle, _ = by_machine(3)
    assert identify(trace, needle, 1, rig=Rig(depth_noise=0.0)).rig == ()
    (known,) = identify(trace, needle, 1, rig=Rig(depth_noise=8e-6)).rig
    assert str(known) == "depth_noise 8e-06 m, stated"


def test_a_part_of_a_trace_has_that_part_of_the_draws():
    quiet, _ = with_quiet_depth(by_machine(1)[0])
    part = quiet[100:400:3]
    assert np.array_equal(part.depths, quiet.depths[:, 100:400:3])

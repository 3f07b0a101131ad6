"""Noise of the depth: it is taken out of the motion, and what is left of it reaches the intervals."""

import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from punctura import Needle
from punctura.identify import Parameters, Rig, identify, search
from punctura.identify.depth_noise import with_quiet_depth
from punctura.identify.fit import Misfit
from punctura.identify.parameters import default_coupling, default_membrane
from punctura.trace import Trace, TraceError

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
    record = found.as_dict()
    left = found.fit.misfit.forces(found.parameters) - found.trace.force
    assert record["rmse_N"] == pytest.approx(np.sqrt(np.mean(left**2))) and record["rmse_N"] > found.fit.weighted_rmse
    (known,) = record["rig"]
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


def by_hand(seed, tremor, rate, noise=0.0):
    """A stroke in and out, smooth but for a tremor (m, 9 Hz), through one wall; the force follows all but the noise."""
    time, depth = TOOL["machine_motion"](6e-3)
    depth = 6e-3 * np.sin(np.pi / 2 * depth / depth.max()) ** 2
    rng = np.random.default_rng(seed)
    spectrum = np.fft.rfft(rng.normal(size=len(time)))
    spectrum *= np.exp(-0.5 * ((np.fft.rfftfreq(len(time), time[1]) - 9) / 1.5) ** 2)
    shake = np.fft.irfft(spectrum, len(time))
    depth += tremor * shake / shake.std()
    row = default_membrane()
    row[:5] = 2e-3, 600.0, 0.2, 0.2, 0.4e-3
    true = Parameters(Needle(1.2e-3, 0.4), np.array([row]), default_coupling(3000.0))
    force = Misfit(Trace(depth, depth, time), true).forces(true) + 5e-3 * rng.normal(size=len(time))
    return Trace(depth + noise * rng.normal(size=len(depth)), force, time)[:: TOOL["DEVICE_HZ"] // rate]


@pytest.mark.parametrize("rate", [100, 50, 25, 12])
def test_a_motion_without_noise_has_none_at_any_rate(rate):
    for seed in range(1, 5):
        traces = [by_hand(seed, tremor, rate) for tremor in (0.0, 30e-6, 100e-6)]
        traces += [random_trace(seed, Conditions(machine=machine, rate=rate))[0] for machine in (False, True)]
        assert [with_quiet_depth(one)[1] for one in traces] == [0.0] * 5


@pytest.mark.parametrize(("tremor", "rate"), [(0.0, 200), (0.0, 100), (0.0, 50), (30e-6, 200), (30e-6, 100)])
def test_noise_is_found_in_the_motion_of_a_hand(tremor, rate):
    for seed in range(1, 5):
        assert with_quiet_depth(by_hand(seed, tremor, rate, NOISE))[1] == pytest.approx(NOISE, rel=0.25)


@pytest.mark.parametrize("rate", [200, 100, 50])
def test_noise_is_found_in_the_motion_of_a_machine(rate):
    for seed in (1, 3, 4):
        found = with_quiet_depth(by_machine(seed)[0][:: 200 // rate])[1]
        assert found == pytest.approx(NOISE, rel=0.25)


def test_slow_samples_need_a_stated_noise():
    """At 25 Hz the tremor of a hand and white noise look alike."""
    shaken = by_hand(1, 0.0, 25, NOISE)
    assert with_quiet_depth(shaken)[1] == 0.0 and with_quiet_depth(shaken, NOISE)[1] == NOISE


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


def test_a_small_noise_counts_beside_the_tremor_of_a_hand():
    for shaken, noise in ((by_hand(1, 30e-6, 200, 0.3e-6), 0.3e-6), (by_hand(1, 100e-6, 200, 2e-6), 2e-6)):
        assert with_quiet_depth(shaken)[1] == pytest.approx(noise, rel=0.15)
        assert with_quiet_depth(shaken, noise)[1] == noise


def test_a_tremor_that_noise_hides_is_not_taken_for_the_turns_of_a_machine():
    """Its residuals are white, too, but its depth is then known far less well."""
    exact = by_hand(1, 30e-6, 200)
    quiet, noise = with_quiet_depth(
        replace(exact, depth=exact.depth + 5e-6 * np.random.default_rng(1).normal(size=len(exact)))
    )
    error = np.sqrt(np.mean((quiet.depth - exact.depth) ** 2))
    assert noise == pytest.approx(5e-6, rel=0.15)
    assert error < 1.15 * np.sqrt(np.mean(quiet.depths.var(axis=0)))


def test_the_last_fit_has_the_weights_of_its_own_model_also_in_a_short_trace(monkeypatch):
    """The search has no weights here; with several walls it has those of another number of walls."""
    trace, needle, _ = by_machine(1)
    monkeypatch.setattr(search, "WEIGHTED", 0)
    found = identify(trace[::2], needle, 1)
    assert len(found.trace) <= search.SEARCHED
    own = found.fit.misfit.with_depth_error(found.parameters).depth_error.weights
    assert found.fit.misfit.depth_error.weights == pytest.approx(own, abs=0.05) and own.min() < 0.5


def test_a_fit_with_weights_that_does_not_end_leaves_the_one_before(monkeypatch):
    def fails(*_):
        raise TraceError("the fit did not end")

    trace, needle, _ = by_machine(1)
    monkeypatch.setattr(search, "fit", fails)
    assert len(identify(trace[::2], needle, 1).estimates) > 0


def test_a_short_trace_says_that_a_stated_noise_is_not_used():
    trace, needle, _ = by_machine(1)
    short = trace[::25]
    found = identify(short, needle, 1, rig=Rig(depth_noise=NOISE))
    assert len(short) < 50 and found.rig == ()
    first, second = found.verdicts[:2]
    assert "cannot be tested" in first and "needs 50 samples, and the trace has 40" in second
    for rig in (Rig(), Rig(depth_noise=0.0), Rig(depth_noise=1e-9)):
        assert not any("needs 50 samples" in one for one in identify(short, needle, 1, rig=rig).verdicts)


STEP = 10e-6


def by_steps(seed, **more):
    return random_trace(seed, Conditions(machine=True, depth_step=STEP, **more))


@pytest.mark.parametrize("seed", [1, 5])
def test_steps_of_the_depth_reach_the_interval_of_the_spring(seed):
    trace, needle, truth = by_steps(seed, force_step=20e-3)
    found = identify(trace, needle, 1)
    spring = next(one for one in found.estimates if one.name == "coupling_stiffness")
    assert spring.low <= truth["coupling_stiffness"] <= spring.high < 1.2 * spring.low
    (known,) = found.rig
    assert (known.name, known.value) == ("depth_noise", pytest.approx(STEP / np.sqrt(12)))


def test_the_depth_between_its_steps_knows_its_own_error():
    """In the rest, all samples have the same error."""
    off, record = [], []
    for seed in range(1, 13):
        exact = by_machine(seed, 0.0)[0]
        quiet, size = with_quiet_depth(by_steps(seed)[0])
        assert size == pytest.approx(STEP / np.sqrt(12))
        rest = (exact.time > 2.25) & (exact.time < 2.55)
        off.append(np.mean((quiet.depth - exact.depth)[rest]))
        record.append(quiet.depths[:, rest].mean(axis=1).std())
    assert 0.7 < np.sqrt(np.mean(np.square(record)) / np.mean(np.square(off))) < 1.2


def test_a_noise_that_is_larger_than_the_steps_is_found():
    trace, _, _ = by_steps(1, depth_noise=20e-6)
    assert with_quiet_depth(trace)[1] == pytest.approx(20e-6, rel=0.25)


def test_a_part_of_a_trace_has_that_part_of_the_draws():
    quiet, _ = with_quiet_depth(by_machine(1)[0])
    part = quiet[100:400:3]
    assert np.array_equal(part.depths, quiet.depths[:, 100:400:3])

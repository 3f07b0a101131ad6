"""A force that falls in a rest and is gone in air is tissue, also where the model is not the right one."""

from dataclasses import replace

import numpy as np
import pytest
from punctura.identify.air_noise import AirNoise
from punctura.identify.criteria import Rule, candidate
from punctura.identify.drifting import slow_misfit
from punctura.identify.fit import Misfit, fit
from punctura.identify.intervals import estimates
from punctura.identify.model import Model, extensions
from punctura.identify.noise import Mixture
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.trace import Trace, segment
from scipy.signal import lfilter
from traces import NEEDLE, force_of, motion, trace

NOISE = 8e-3


def silicone(drift=0.0):
    """A force that no K06 wall has: it rises as a square, is cut, and relaxes in the rest. Every 20th sample."""
    time, depth = motion(hold=4.0)
    time, depth = time[::10], depth[::10]
    grown = np.where(depth > 4e-3, ((depth - 4e-3) / 11e-3) ** 2, 0.0)
    out = np.arange(len(depth)) > np.argmax(depth) + 40
    rest = np.clip(time - time[int(np.argmax(depth))], 0, None)
    force = 4 * grown * np.where(out, -0.3, 0.6 + 0.4 * np.exp(-rest / 0.8))
    force += drift * time / time[-1] + NOISE * np.random.default_rng(1).normal(size=len(time))
    return Trace(depth, force, time)


def one_wall():
    row = default_membrane()
    row[:5] = [4e-3, 600, 0.3, 0.2, 0.5e-3]
    return Parameters(NEEDLE, np.array([row]), default_coupling(600))


def test_a_relaxation_is_preferred_where_the_air_excludes_a_drift():
    made = silicone()
    rule, start = Rule(made, segment(made)), one_wall()
    assert rule.air.relaxes
    misfit = Misfit(made, start, zero=rule.air.zero)
    relaxation = next(one for one in extensions(NEEDLE) if one.name == "relaxation")
    small, large = Model(1), Model(1, (relaxation,))
    one = candidate("K06", small, fit(misfit, small.names, start))
    two = candidate("relaxation", large, fit(misfit, large.names, large.start(one.fit.parameters)))
    assert one.fit.rmse > 10 * NOISE  # neither is right
    assert rule.prefers(two, one) and not rule.prefers(one, two)
    assert max(np.abs(rule.air.zero)) < 0.1
    assert all(abs(fitted.fit.parameters.get("offset")) < 0.1 for fitted in (one, two))


def test_a_model_that_does_not_explain_the_trace_is_named_once():
    made, model = silicone(), Model(1)
    found = fit(Misfit(made, one_wall()), model.names, one_wall())
    air = AirNoise(made, segment(made))
    told = [" ".join(map(str, slow_misfit(found, air, explained))) for explained in (True, False)]
    assert ["misses the measured force" in text for text in told] == [True, False]


def test_a_sensor_that_drifts_in_air_may_be_the_reason():
    made = silicone(drift=1.2)
    assert not AirNoise(made, segment(made)).relaxes


def test_a_rest_in_which_nothing_changes_shows_no_relaxation():
    time, depth = motion(hold=2.0)
    force = force_of(depth) + NOISE * np.random.default_rng(2).normal(size=len(time))
    made = Trace(depth, force, time)
    assert not AirNoise(made, segment(made)).relaxes


@pytest.mark.parametrize(("slow", "allowed"), [(2.0, True), (40.0, False)])
def test_the_air_bounds_a_slow_noise(slow, allowed):
    made = silicone()
    variance = NOISE**2 * (1 + slow**2)
    air = AirNoise(made, segment(made))
    assert air.allows(Mixture(0.0, 1.0), NOISE**2)
    assert air.allows(Mixture(slow**2 / (1 + slow**2), 100.0), variance) == allowed


def test_the_air_bounds_an_offset_that_the_fit_leaves_open():
    made, model, zero = silicone(), Model(1), 1e-3
    found = fit(Misfit(made, one_wall(), zero=(-zero, zero)), model.names, one_wall())
    offset = next(one for one in estimates(found, stops=False, outwards=False) if one.name == "offset")
    assert offset.identifiable and (offset.low, offset.high) == pytest.approx((-zero, zero), rel=0.1)


def test_a_noise_of_a_correlation_that_air_has_is_not_shown_in_a_size_that_air_has_not():
    made = trace(noise=0.0, surface=12e-3)
    ends = segment(made)
    rough = lfilter([np.sqrt(2 / 100)], [1, -np.exp(-1 / 100)], np.random.default_rng(3).normal(size=len(made)))
    air = AirNoise(replace(made, force=made.force + 1e-3 * rough), ends)
    slow = Mixture(1.0, 100.0)
    assert air.shows(slow, 1e-3**2) and air.tested(slow, 1e-3**2)
    assert not air.shows(slow, 3e-3**2) and not air.tested(slow, 3e-3**2)


def test_one_quiet_end_excludes_a_noise_that_the_other_end_has():
    made = trace(noise=1e-4, surface=12e-3)
    ends = segment(made)
    walk = 0.1 / np.sqrt(400) * np.cumsum(np.random.default_rng(1).normal(size=len(made)))
    slow = Mixture(1.0, 800.0)
    one = replace(made, force=made.force + np.where(np.arange(len(made)) >= ends.exit, walk - walk[ends.exit], 0.0))
    assert not AirNoise(one, ends).allows(slow, 0.1**2)
    both = replace(made, force=made.force + walk)
    assert AirNoise(both, ends).allows(slow, 0.1**2) and AirNoise(both, ends).shows(slow, 0.1**2)

"""A slow drift of the force sensor: it is not taken for a relaxation of the tissue, and it is named."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from punctura.identify import identify
from punctura.identify.criteria import Rule, candidate
from punctura.identify.fit import Misfit, fit
from punctura.identify.model import Model, extensions
from punctura.identify.noise import NoiseOfFit
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.identify.search import thinned
from punctura.identify.verdict import verdicts
from punctura.trace import Trace, TraceError, segment
from traces import NEEDLE, force_of, motion

TOOL = runpy.run_path(str(Path(__file__).parents[3] / "tools" / "try_intervals.py"))


def models(needle):
    """K06 with one membrane, and the same with a relaxation."""
    return Model(1), Model(1, (next(one for one in extensions(needle) if one.name == "relaxation"),))


def test_a_drift_is_not_taken_for_a_relaxation_and_is_named(monkeypatch):
    clean, needle, truth = TOOL["random_trace"](2, TOOL["Conditions"](noise=0.0))
    rng, n = np.random.default_rng(2009), len(clean)
    noise = 0.01 * rng.normal(size=n) + 0.03 * TOOL["correlated"](rng, n, float(np.exp(-1 / 200)))
    made = thinned(Trace(clean.depth, clean.force + noise, clean.time))
    row = default_membrane()
    row[:5] = [
        truth[f"membrane[0].{kind}"] for kind in ("surface", "stiffness", "precompression", "friction", "thickness")
    ]
    start = Parameters(needle, np.array([row]), default_coupling(truth["coupling_stiffness"]))
    rule, misfit, (small, large) = Rule(made, segment(made)), Misfit(made, start), models(needle)
    one = candidate("K06", small, fit(misfit, small.names, start))
    ends = [fit(misfit, large.names, large.start(one.fit.parameters, weak)) for weak in (True, False)]
    two = candidate("relaxation", large, min(ends, key=lambda end: end.sse))
    assert not rule.prefers(two, one)
    assert any("drifts slowly" in text for text in verdicts((), made, segment(made), one.fit, rule.air))
    monkeypatch.setattr(Rule, "_may_be_slow_noise", lambda self, new, old: False)
    assert rule.prefers(two, one)  # the noise is of the kind that looks like a relaxation


def test_a_relaxation_of_the_tissue_is_still_preferred():
    time, depth = motion(speed=10e-3, hold=2.0)
    row = default_membrane()
    row[:5] = [5e-3, 600, 0.3, 0.2, 0.5e-3]
    plain = Parameters(NEEDLE, np.array([row]), default_coupling(4000))
    relaxing = plain.with_values({"relaxation_1_stiffness": 3000, "relaxation_1_time": 0.3})
    made = thinned(Trace(depth, force_of(depth), time))
    noise = 0.005 * np.random.default_rng(1).normal(size=len(made))
    made = Trace(made.depth, Misfit(made, relaxing).forces(relaxing) + noise, made.time)
    misfit, (small, large) = Misfit(made, plain), models(NEEDLE)
    one = candidate("K06", small, fit(misfit, small.names, plain))
    two = candidate("relaxation", large, fit(misfit, large.names, relaxing))
    rule = Rule(made, segment(made))
    assert rule.prefers(two, one)
    assert not any("drifts slowly" in text for text in verdicts((), made, segment(made), two.fit, rule.air))


@pytest.mark.parametrize("seed", [132004, 132010])  # they had two walls
def test_a_wall_is_not_added_for_slow_noise(seed):
    given = TOOL["Conditions"](machine=True, auto=True, rate=50, drift=0.1)
    trace, needle, _ = TOOL["random_trace"](seed, given)
    found = identify(trace, needle)
    assert len(found.parameters.membranes) == 1
    assert any("A wall that adds less than 0." in text and "cannot be told from it" in text for text in found.verdicts)


@pytest.mark.parametrize(
    ("seed", "noise", "walls", "said"),
    [
        (232083, {"walk": 0.1}, 1, True),  # they were called explained, with a second wall that is not there
        pytest.param(231023, {"drift": 0.1}, 1, True, marks=pytest.mark.statistics),
        pytest.param(236002, {"drift": 0.03}, 2, False, marks=pytest.mark.statistics),
    ],
)
def test_a_wall_that_falls_by_no_more_than_slow_noise_may_be_none(seed, noise, walls, said):
    given = TOOL["Conditions"](machine=True, auto=True, rate=50, walls=walls, apart=1.3, **noise)
    trace, needle, _ = TOOL["random_trace"](seed, given)
    found = identify(trace, needle)
    assert len(found.parameters.membranes) == 2 and found.doubts.whole is not said
    assert ("maybe_wall" in [cause.kind for cause in found.doubts.causes]) is said


def test_slow_noise_makes_no_asymmetric_way_out():
    trace, needle, _ = TOOL["random_trace"](212055, TOOL["Conditions"](machine=True, rate=50, drift=0.1))
    assert identify(trace, needle).doubts.whole


@pytest.mark.parametrize("slow", [{}, {"drift": 0.03}, {"walk": 0.1}])
def test_a_needle_that_touches_nothing_has_no_law(slow):
    trace, needle, _ = TOOL["random_trace"](3, TOOL["Conditions"](machine=True, rate=50, air=True, **slow))
    with pytest.raises(TraceError, match="no contact: a zero of the sensor and noise of 0"):
        identify(trace, needle)


@pytest.mark.parametrize(("slow", "white"), [(0.0, 1.0), (3.0, 1.0)])
def test_slow_and_white_noise_are_told_apart(slow, white):
    rng, n = np.random.default_rng(5), 600
    noise = slow * TOOL["correlated"](rng, n, float(np.exp(-1 / 60))) + white * rng.normal(size=n)
    columns = np.column_stack((np.ones(n), np.sin(np.arange(n) / 30)))
    left = noise - columns @ np.linalg.lstsq(columns, noise, rcond=None)[0]
    assert NoiseOfFit(left, columns).slow_and_white() == pytest.approx((slow, white), abs=0.35 * max(slow, white))

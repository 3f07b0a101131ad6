"""A long trace: means of neighbouring samples tell as much as all of them."""

import numpy as np
import punctura as pn
from punctura.identify import identify
from punctura.identify.search import MOST_SAMPLES, MOVING, in_means
from punctura.trace import Trace, segment
from punctura.trace.friction import Slide
from traces import MEMBRANE, NEEDLE

RATE = 8000.0


def long_trace(hold=1.0):
    going = np.arange(0, 15e-3, 5e-3 / RATE)
    depth = np.concatenate((going, np.full(int(hold * RATE), 15e-3), going[::-1]))
    law, coupling = pn.ThickLaw(NEEDLE, MEMBRANE), pn.Coupling(4000, 1.0)
    force = -pn.Proxy1d(law, coupling, 1 / RATE).run(depth - 5e-3).force
    noise = 0.02 * np.random.default_rng(5).normal(size=len(depth))
    return Trace(depth, force + noise, np.arange(len(depth)) / RATE)


def test_the_means_of_a_long_trace_have_the_values_and_intervals_of_all_its_samples(monkeypatch):
    made = long_trace()
    means = identify(made, NEEDLE)
    assert MOST_SAMPLES <= len(means.trace) < 2 * MOST_SAMPLES < len(made)
    assert f"The trace has {len(made)} samples, so the fit is to the {len(means.trace)} means" in means.verdicts[0]
    assert means.doubts.whole
    monkeypatch.setattr("punctura.identify.search.MOST_SAMPLES", len(made))
    every = identify(made, NEEDLE)
    assert len(every.trace) == len(made) and not any("means" in verdict for verdict in every.verdicts)
    for one, other in zip(means.estimates, every.estimates, strict=True):
        width = other.high - other.low
        np.testing.assert_allclose((one.low, one.value, one.high), (other.low, other.value, other.high), atol=width / 3)
        wider = 1.25 if one.name != "offset" else 1.6  # it allows for slow noise, which fewer samples exclude less
        assert 0.8 * width < one.high - one.low < wider * width, one.name


def test_a_long_rest_costs_no_samples_of_the_motion():
    made = long_trace(hold=60.0)
    few = in_means(made, segment(made))
    moving = sum(stroke.end - stroke.start for stroke in segment(few).strokes if stroke.kind != "hold")
    assert len(few) < len(made) / 40 and MOVING <= moving < 2 * MOVING
    slow = made[:: int(RATE / 100)]  # 600 samples of motion: none to spare
    assert in_means(slow, segment(slow)) is slow


def test_a_trace_that_turns_without_a_rest_keeps_its_samples():
    for hold in (0.0, 1e-3):
        made = long_trace(hold)
        assert in_means(made, segment(made)) is made


def test_means_take_the_draws_of_the_depth_and_the_rig_along():
    rows = np.arange(11.0)
    slide = Slide(rows, np.zeros(1), np.ones(1))
    made = Trace(
        rows, 2 * rows, 3 * rows, depths=np.array([rows, 4 * rows]), rig=np.tile(rows[:, None], 5), slide=slide
    )
    few = made.means(2)
    middle = np.array([1.5, 3.5, 5.5, 7.5, 9.5])  # of the last ten
    np.testing.assert_array_equal(np.array([few.depth, few.force / 2, few.time / 3]), np.tile(middle, (3, 1)))
    np.testing.assert_array_equal(few.depths, [middle, 4 * middle])
    np.testing.assert_array_equal(few.rig, np.tile(middle[:, None], 5))
    np.testing.assert_array_equal(few.slide.way, middle)

"""Segments of synthetic traces against the motion that made them."""

import numpy as np
import pytest
from punctura.trace import Trace, TraceError, segment
from punctura.trace.turns import noise_of, turning_points
from traces import trace


def test_contact_and_pop_are_found_where_the_membrane_is():
    found = segment(measured := trace())
    assert measured.depth[found.contact] == pytest.approx(5e-3, abs=0.2e-3)
    assert len(found.pops) == 1
    pop = found.pops[0]
    assert measured.depth[pop.start] == pytest.approx(5e-3 + 1.2e-3 / np.tan(0.4), abs=1e-3)
    assert pop.drop > 0.2 and 0 < pop.width < 2e-3


def test_strokes_of_three_insertions_with_holds():
    found = segment(measured := trace(times=3))
    assert [stroke.kind for stroke in found.strokes] == ["in", "hold", "out"] * 3
    assert [stroke.insertion for stroke in found.strokes] == [0, 0, 0, 1, 1, 1, 2, 2, 2]
    assert found.insertions == 3 and len(found.holds) == 3 and len(found.reversals) == 5
    assert set(measured.strokes.tolist()) == {0, 1, 2}


def test_a_trace_without_time_has_no_holds():
    timed = trace(hold=0)
    found = segment(Trace(timed.depth, timed.force))
    assert [stroke.kind for stroke in found.strokes] == ["in", "out"] and found.holds == ()


def test_turning_points_ignore_turns_below_the_hysteresis():
    curve = np.array([0, 1, 2, 1.9, 3, 2.95, 0, 0.05, -1, 4])
    assert turning_points(curve, 0.5) == [0, 4, 8, 9]
    assert turning_points(np.zeros(7), 0.5) == [0, 6]


def test_noise_is_told_from_the_curve_below_it():
    rng = np.random.default_rng(2)
    curve = np.sin(np.linspace(0, 3, 4000)) + 0.01 * rng.normal(size=4000)
    assert noise_of(curve) == pytest.approx(0.01, rel=0.1)


def test_arrays_that_do_not_fit_together_are_refused():
    depth = np.arange(9.0)
    with pytest.raises(TraceError, match="force must hold one number for each of the 9 depths"):
        Trace(depth, depth[:-1])
    with pytest.raises(TraceError, match="time does not grow at sample 5"):
        Trace(depth, depth, np.array([0, 1, 2, 3, 4, 4, 6, 7, 8.0]))
    with pytest.raises(TraceError, match="NaN or infinite"):
        Trace(depth, depth * np.nan)
    with pytest.raises(TraceError, match="at least 5"):
        Trace(depth[:3], depth[:3])
    with pytest.raises(ValueError, match="read-only"):
        Trace(depth, depth).force[0] = 1

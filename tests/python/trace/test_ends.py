"""Traces that begin in tissue: no zero is taken from there, and none is said to have drifted."""

from dataclasses import replace

import numpy as np
import pytest
from punctura.identify.doubts import doubts
from punctura.identify.fit import Misfit, fit
from punctura.identify.model import Model
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.trace import Trace, segment
from punctura.trace.findings import examine
from punctura.trace.numbers import numbers_of
from traces import MEMBRANE, NEEDLE, RATE, force_of

NOISE = 6e-3


def moved(points, surfaces, begin):
    """The trace of a motion through points (s, m), that is recorded from the time `begin` on."""
    times, depths = np.array(points).T
    time = np.arange(0, times[-1], 1 / RATE)
    depth = np.interp(time, times, depths)
    force = sum(force_of(depth, surface) for surface in surfaces) + NOISE * np.random.default_rng(4).normal(
        size=len(time)
    )
    kept = time >= begin
    return Trace(depth[kept], force[kept], time[kept] - begin)


def inside():
    """The needle is through a wall at -6 mm from the first sample to the last one, and goes through one at 5 mm."""
    points = [(0, -8e-3), (3, -1e-3), (3.6, 0), (4.6, 0), (8.6, 12e-3), (9.6, 12e-3), (13.6, 0), (14.6, 0)]
    return moved(points, (-6e-3, 5e-3), 3.3)


def preloaded():
    """The needle rests at 6.2 mm, and presses on a wall at 5 mm. It ends in air."""
    return moved([(0, 0), (2, 6.2e-3), (3, 6.2e-3), (5, 12e-3), (6, 12e-3), (10, 0), (11, 0)], (5e-3,), 2.3)


def told(trace):
    return {finding.kind: finding.text for finding in trace.findings}


@pytest.mark.parametrize("zero", [0.0, 3.0])
def test_without_air_nothing_is_subtracted_as_if_it_were_air(zero):
    made = inside()
    read = examine(replace(made, force=made.force + zero))
    found = told(read)
    assert {"offset", "drift"} & found.keys() == set() and "warm up" not in str(found)
    assert (
        "tissue that the needle is in from the beginning" in found["no_air"] and "drifts at neither" in found["no_air"]
    )
    assert np.mean(read.force - made.force) == pytest.approx(0, abs=0.01)  # the middle, if 0 N cannot be the zero
    assert numbers_of(read)[0].zero_N == 0 and read.depth[segment(read).contact] == pytest.approx(5e-3, abs=0.1e-3)


def test_a_zero_that_is_not_known_makes_no_barbs_and_no_wall_in_air():
    read = examine(inside())
    row = default_membrane()
    row[:5] = -6e-3, MEMBRANE.stiffness, MEMBRANE.precompression, MEMBRANE.friction, MEMBRANE.thickness
    second = row.copy()
    second[0] = 5e-3
    truth = Parameters(NEEDLE, np.array([row, second]), default_coupling(4000.0))
    names = [name for name in Model(2).names if not name.startswith("membrane[0]")]
    verdict = doubts(read, segment(read), fit(Misfit(read, truth), names, truth), ())
    assert [cause.kind for cause in verdict.causes] == ["no_air"] and verdict.explained.ok
    assert verdict.explained.noise == pytest.approx(NOISE, rel=0.2)


@pytest.mark.parametrize("tared", [False, True])
def test_a_needle_that_presses_on_tissue_from_the_beginning_has_its_zero_behind_it(tared):
    made = preloaded()
    read = examine(replace(made, force=made.force - tared * made.force[:50].mean()))
    found = told(read)
    assert {"drift", "no_air"} & found.keys() == set() and ("offset" in found) == tared
    assert "as where a needle presses" in found["no_contact"]
    assert segment(read).contact is None and read.force == pytest.approx(made.force, abs=0.01)


def test_a_sensor_that_drifts_evenly_is_said_to_drift():
    made = moved([(0, 0), (1, 0), (5, 12e-3), (6, 12e-3), (10, 0), (11, 0)], (5e-3,), 0)
    drifting = examine(replace(made, force=made.force - 0.02 * made.time))
    assert "warm up" in told(drifting)["drift"] and segment(drifting).contact is not None

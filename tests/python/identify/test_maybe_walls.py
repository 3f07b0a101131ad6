"""Walls that may be none: they pop within some samples of each other, or not at all."""

import numpy as np
import punctura as pn
import pytest
from punctura.identify import identify
from punctura.identify.fit import Misfit, fit
from punctura.identify.maybe_walls import maybe_walls
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.trace import Trace
from traces import MEMBRANE, NEEDLE, force_of, motion


def test_without_a_pop_the_number_of_walls_is_in_doubt():
    time, depth = motion(deepest=7e-3)
    force = force_of(depth) + force_of(depth, 6e-3, pn.Membrane(300, 0.15, MEMBRANE.friction, MEMBRANE.thickness))
    found = identify(Trace(depth, force + 8e-3 * np.random.default_rng(1).normal(size=len(depth)), time), NEEDLE, 2)
    assert not found.segments.pops and not found.doubts.whole
    (cause,) = [cause for cause in found.doubts.causes if cause.kind == "maybe_wall"]
    assert "no wall pops" in cause.text


@pytest.mark.parametrize(("apart", "doubtful"), [(20e-6, True), (2e-3, False)])
def test_two_walls_that_pop_within_three_samples_may_be_one(apart, doubtful):
    half, (time, depth) = pn.Membrane(300, 0.15, MEMBRANE.friction, MEMBRANE.thickness), motion()
    force = force_of(depth, membrane=half) + force_of(depth, 5e-3 + apart, half)
    made = Trace(depth, force + 8e-3 * np.random.default_rng(1).normal(size=len(depth)), time)
    rows = np.array([default_membrane()] * 2)
    rows[:, :5] = 5e-3, half.stiffness, half.precompression, half.friction, half.thickness
    rows[1, 0] += apart
    start = Parameters(NEEDLE, rows, default_coupling(4000.0))
    found = maybe_walls(fit(Misfit(made, start), ("offset",), start), True)
    assert [cause.kind for cause in found] == ["maybe_wall"] * doubtful

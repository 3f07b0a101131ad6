"""Noise that grows with the force: each sample counts by its own, and it is no misfit of the model."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from punctura.identify import identify
from punctura.identify.explained import explained
from punctura.identify.fit import Misfit, fit
from punctura.identify.growing_noise import growth
from punctura.identify.model import Model
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.trace import Trace, segment
from traces import MEMBRANE, NEEDLE, force_of, motion

TOOL = runpy.run_path(str(Path(__file__).parents[3] / "tools" / "try_intervals.py"))
Conditions, random_trace = TOOL["Conditions"], TOOL["random_trace"]


def trace(share, seed=1):
    time, depth = motion()
    force = force_of(depth)
    size = np.hypot(5e-3, share * force)
    return Trace(depth, force + size * np.random.default_rng(seed).normal(size=len(depth)), time)


@pytest.mark.parametrize("seed", range(5))
def test_the_growth_is_found_and_white_noise_has_none(seed):
    for share in (0.0, 0.05):
        found = identify(made := trace(share, seed), NEEDLE, 1)
        peak = float(np.max(np.abs(force_of(made.depth))))
        assert growth(made, segment(made), found.fit) == pytest.approx(share * peak / 5e-3, rel=0.35)
        weights = found.fit.misfit.depth_error.weights
        assert weights.max() == pytest.approx(1, abs=0.01) and (weights.min() < 0.3) == (share > 0)


@pytest.mark.parametrize("seed", [40003, 40007])
def test_it_is_no_misfit_of_the_model(seed):
    made, needle, _ = random_trace(seed, Conditions(machine=True, growing=0.05))
    assert identify(made, needle, 1).doubts.explained.ok


def test_a_model_that_is_wrong_where_the_force_is_large_is_no_growing_noise():
    time, depth = motion()
    force = force_of(depth) * (1 + 0.1 * np.sin(2 * np.pi * time / 0.12))
    bent = Trace(depth, force + 3e-4 * np.random.default_rng(1).normal(size=len(depth)), time)
    truth = default_membrane()
    truth[:5] = 5e-3, MEMBRANE.stiffness, MEMBRANE.precompression, MEMBRANE.friction, MEMBRANE.thickness
    start = Parameters(NEEDLE, np.array([truth]), default_coupling(4000.0))
    found = fit(Misfit(bent, start), Model(1).names, start)
    assert growth(bent, segment(bent), found) == 0 and not explained(bent, segment(bent), found).ok

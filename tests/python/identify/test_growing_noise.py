"""Noise that grows with the force: each sample counts by its own, and it is no misfit of the model."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from punctura.identify import identify
from punctura.identify.growing_noise import growth
from punctura.trace import Trace, segment
from traces import NEEDLE, force_of, motion

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

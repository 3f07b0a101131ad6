"""A fit beside slow noise of the sensor: least squares of what is white, not of what was measured."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from punctura.identify import identify
from punctura.identify.intervals import estimates
from punctura.identify.noise import Mixture
from punctura.identify.whitening import Whitening
from traces import NEEDLE, trace

TOOL = runpy.run_path(str(Path(__file__).parents[3] / "tools" / "try_intervals.py"))


@pytest.mark.parametrize("mixture", [Mixture(0.06, 3.0), Mixture(0.8, 12.0), Mixture(1.0, 30.0), Mixture(0.94, 200.0)])
def test_whitened_noise_is_white_and_the_last_sample_keeps_its_size(mixture):
    n = 80
    lags = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    dense = mixture.share * np.exp(-lags / mixture.length) + (1 - mixture.share) * np.eye(n)
    whitening = Whitening(mixture, n)
    whole = whitening(np.eye(n))
    white = whole @ dense @ whole.T
    np.testing.assert_allclose(white, white[0, 0] * np.eye(n), atol=1e-12)
    assert whole[-1, -1] == pytest.approx(1)
    np.testing.assert_allclose(whitening.back(np.eye(n)), whole.T, atol=1e-12)


@pytest.mark.parametrize("seed", [2, pytest.param(20023, marks=pytest.mark.statistics)])
def test_a_random_walk_that_the_air_shows_is_no_wall_and_leaves_narrow_intervals(seed):
    made, needle, truth = TOOL["random_trace"](seed, TOOL["Conditions"](machine=True, walk=0.03))
    found = identify(made, needle)
    assert len(found.parameters.membranes) == 1 and found.doubts.explained.ok and found.extensions == ()
    assert all(one.identifiable and one.low < truth.get(one.name, one.value) < one.high for one in found.estimates[2:6])
    assert any("drifts slowly" in one and "intervals may be too narrow" in one for one in found.verdicts)
    squares = {one.name: one for one in estimates(found.fit.measured, stops=False)}
    for one in found.estimates[1:4]:  # stiffness, precompression, friction
        least = squares[one.name]
        assert one.high - one.low < 0.7 * (least.high - least.low), one.name


def test_no_extension_is_fitted_where_nothing_but_white_noise_is_left():
    steps = []
    identify(trace(noise=0.01, seed=2), NEEDLE, membranes=1, report=steps.append)
    assert not {"curved grip", "tip length", "tail", "set"} & set(steps)

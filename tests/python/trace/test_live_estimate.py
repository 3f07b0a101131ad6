"""The live estimate in Python: arrays, and a simulated insertion."""

import numpy as np
import punctura as pn
import pytest
from punctura.live import LiveEstimate

PERIOD = 1 / 1600
DOWN = (0, -1, 0)


@pytest.fixture(scope="module")
def stroke():
    """Depth (n,) and force against the insertion (n,) of one stroke in and out of K06's membrane of 0.1 mm."""
    scene = pn.load_scene("k06-fig10")
    way = np.concatenate([np.arange(-3e-3, 9e-3, 5e-3 * PERIOD), np.full(800, 9e-3), np.arange(9e-3, -3e-3, -5e-6)])
    surface = np.array(scene.membranes[0].point)
    ticks = pn.Insertion(scene).run(surface + np.outer(way, DOWN), DOWN)
    noise = 4e-3 * np.random.default_rng(4).standard_normal(len(way))
    return way, ticks.force[:, 1] + noise


def test_one_pop_is_found_with_slope_plateau_and_place(stroke):
    way, force = stroke
    live = LiveEstimate()
    inwards = int(np.argmax(way >= 8.9e-3))
    estimates = live.run(way[:inwards], force[:inwards], PERIOD)
    assert live.punctures == 1
    assert live.phase == "behind"
    (found,) = np.flatnonzero(estimates["punctured"])
    peak = int(np.argmax(force[:inwards]))
    assert 0 <= found - peak < 60  # K06's wall of 0.1 mm at 5 mm/s lets go within 20 ms
    value, error = live.plateau
    assert value == pytest.approx(0.41024, abs=4 * error + 2e-3)
    assert estimates["slope"][peak - 300] == pytest.approx(117.57 * 400 / (117.57 + 400), rel=0.1)  # A_I and K
    assert live.drop == pytest.approx(0.32, abs=0.03)
    live.run(way[inwards:], force[inwards:], PERIOD)
    assert live.punctures == 1  # neither the hold nor the withdrawal
    assert live.phase == "free"


def test_the_state_of_an_estimate_with_other_settings_is_refused():
    live = LiveEstimate(noise=6e-3, least_drop=0.05)
    with pytest.raises(ValueError, match="no state of this LiveEstimate"):
        LiveEstimate().state = live.state


def test_bad_samples_are_counted_and_reset_forgets(stroke):
    way, force = stroke
    live = LiveEstimate()
    live.run(way[:3000], np.where(np.arange(3000) % 100 == 7, np.nan, force[:3000]), PERIOD)
    assert live.ignored == 30
    live.reset()
    assert (live.ignored, live.punctures, live.phase, live.slope) == (0, 0, "free", None)
    with pytest.raises(pn.ConfigurationError, match=r"live_estimate.least_share"):
        LiveEstimate(least_share=1.5)
    with pytest.raises(ValueError, match="one value for each depth"):
        live.run([0, 1], [0], PERIOD)

"""Compares conditioned positions with an independent line fit, and checks ServoSettings."""

import numpy as np
import punctura
import pytest
from oracles import signal
from punctura.scene import ServoSettings

COUNT = 5.5e-5
AWAY = punctura.PlacedMembrane("m", punctura.Membrane(570.0, 0.41, 0.2, 1e-3), [0, -1, 0], [0, -1, 0])


def insertion(rate=1600.0, **servo):
    settings = ServoSettings(rate=rate, **servo)
    return punctura.Insertion(
        punctura.Scene("s", punctura.Needle(1.08e-3, 0.28), punctura.Coupling(400.0, 1.0), [AWAY], settings)
    )


def tips(run, p):
    out = np.empty_like(p)
    for k, row in enumerate(p):
        run.step(row, [0, -1, 0])
        out[k] = run.tip
    return out


def wander(rng, ticks, rate):
    """A hand's strokes with tremor, a stop and a jump, through encoders."""
    t = np.arange(ticks) / rate
    path = 3e-3 * np.sin(5 * t) + 1e-4 * np.sin(60 * t)
    path[ticks // 3 : ticks // 2] = path[ticks // 3]
    path[3 * ticks // 4 :] += 2e-3
    axes = np.stack([path, 0.3 * path, 0.01 * path], axis=1)
    return (np.round(axes / COUNT + rng.random(3)) + rng.integers(-1, 2, axes.shape)) * COUNT


@pytest.mark.parametrize("finer", [1.0, 0.3, 0.1])
@pytest.mark.parametrize("rate", [600.0, 4000.0])
def test_the_line_fit_is_the_end_of_the_longest_line_that_fits(rate, finer):
    p = wander(np.random.default_rng(7), 1200, rate) * finer
    step = 1.003 * COUNT * finer  # so that no sample lies exactly on the tolerance, where rounding would decide
    found = tips(insertion(rate, conditioning="line_fit", encoder_step=step), p)
    for i in range(3):
        assert abs(found[:, i] - signal.line_fit(p[:, i], rate, step)).max() <= 1e-12


def test_settings_are_values_and_tell_what_is_wrong_with_them():
    settings = ServoSettings(conditioning="line_fit", encoder_step=1e-5)
    assert settings.replace(solver="paper") == ServoSettings(1600.0, 300.0, "paper", "line_fit", 1e-5)
    assert "conditioning='line_fit', encoder_step=1e-05" in repr(settings)
    with pytest.raises(
        punctura.ConfigurationError, match=r"servo.conditioning = .*must be \"low_pass\" or \"line_fit\""
    ):
        ServoSettings(conditioning="smooth")
    with pytest.raises(punctura.ConfigurationError, match=r"servo.encoder_step = 0.01: must be from 0"):
        insertion(encoder_step=0.01)

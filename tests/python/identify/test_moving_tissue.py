"""Tissue that breathes or pulses: the model that stands still is doubted, and the motion is named."""

import numpy as np
import pytest
from punctura.identify import identify
from punctura.trace import Trace
from traces import NEEDLE, force_of, motion


def measured(depth, force):
    noise = 8e-3 * np.random.default_rng(4).normal(size=len(depth))
    return Trace(depth, force + noise, np.arange(len(depth)) / 200)


@pytest.mark.parametrize(("size", "rate", "words"), [(400e-6, 0.3, "0.3 times"), (80e-6, 1.2, "1.2 times")])
def test_tissue_that_swings_is_named_with_its_size_and_frequency(size, rate, words):
    time, depth = motion(deepest=12e-3, speed=3e-3, hold=2.0)
    found = identify(measured(depth, force_of(depth + size * np.sin(2 * np.pi * rate * time))), NEEDLE)
    (cause,) = found.doubts.causes
    assert cause.kind == "moving_tissue" and cause.share > 0.9 and words in cause.text
    told = float(cause.text.partition("forth by ±")[2].partition(" um")[0])
    assert told == pytest.approx(1e6 * size, rel=0.15)


def test_another_misfit_is_no_motion_of_the_tissue():
    _, depth = motion(deepest=12e-3, speed=3e-3)
    force = force_of(depth)
    found = identify(measured(depth, np.where(force < 0, 2 * force, force)), NEEDLE, 1)
    assert not found.doubts.explained.ok
    assert "moving_tissue" not in [cause.kind for cause in found.doubts.causes]

"""The rounding of a sensor, from its values."""

import numpy as np
import pytest
from punctura.trace.samples import rounding

SMOOTH = np.sin(np.linspace(0, 3, 400)) + 1e-3 * np.random.default_rng(1).normal(size=400)


@pytest.mark.parametrize("step", [0.02, 0.0075, 1 / 300])
@pytest.mark.parametrize("zero", [0.0, 0.123456])
def test_steps_are_found(step, zero):
    stepped = np.round(np.round(SMOOTH / step) * step, 5) + zero
    assert rounding(stepped) == pytest.approx(step / np.sqrt(12), rel=1e-2)


def test_steps_of_which_one_is_never_seen_alone_are_found():
    assert rounding(0.1 * np.array([0, 2, 5, 7, 9, 12, 14])) == pytest.approx(0.1 / np.sqrt(12))


@pytest.mark.parametrize("values", [SMOOTH, np.zeros(9), np.array([0.0, 1.0, 0.0, 1.0]), SMOOTH[:8]])
def test_values_on_no_grid_have_none(values):
    assert rounding(values) == 0.0

"""A force that a program has smoothed or filled in, and a depth that a slower sensor holds: one wall stays one wall."""

from dataclasses import replace

import numpy as np
import pytest
from punctura.identify import identify
from punctura.trace.findings import examine
from scipy.signal import butter, lfilter, medfilt
from traces import MEMBRANE, NEEDLE, trace

TRUTH = {
    "membrane[0].surface": 5e-3, "membrane[0].stiffness": MEMBRANE.stiffness, "membrane[0].friction": MEMBRANE.friction,
    "membrane[0].precompression": MEMBRANE.precompression, "membrane[0].thickness": MEMBRANE.thickness,
    "coupling_stiffness": 4000.0,
}  # fmt: skip
MADE = trace(noise=0.02)
SMEARED = {
    "long moving average": lambda force: np.convolve(np.pad(force, 25, "edge"), np.ones(51) / 51, "valid"),
    "moving average": lambda force: np.convolve(np.pad(force, 10, "edge"), np.ones(21) / 21, "valid"),
    "low-pass of second order": lambda force: lfilter(*butter(2, 6, fs=200), force),
    "filled in": lambda force: np.interp(MADE.time, MADE.time[::10], force[::10]),
    "median": lambda force: medfilt(force, 21),
    "held": lambda force: np.repeat(force[::10], 10)[: len(force)],
}

QUICK = ("moving average", "filled in", "median")


def held(found):
    return [
        one.name for one in found.estimates
        if (one.low is None or one.low <= TRUTH.get(one.name, one.low))
        and (one.high is None or TRUTH.get(one.name, one.high) <= one.high)
    ]  # fmt: skip


@pytest.mark.parametrize(
    "filtered",
    [one if name in QUICK else pytest.param(one, marks=pytest.mark.statistics) for name, one in SMEARED.items()],
    ids=SMEARED,
)
def test_a_force_that_is_smoothed_or_filled_in_shows_one_wall_and_wide_intervals(filtered):
    made = examine(replace(MADE, force=filtered(MADE.force)))
    assert [one.kind for one in made.findings] == ["smoothed"]
    found = identify(made, NEEDLE)
    assert len(found.parameters.membranes) == 1 and "smoothed or filled in" in " ".join(found.verdicts[:2])
    assert set(TRUTH) <= set(held(found))


def test_a_depth_that_is_held_for_ten_samples_makes_no_lag():
    made = trace(noise=0.01)
    slow = examine(replace(made, depth=np.repeat(made.depth[::10], 10)[: len(made)]))
    assert [one.kind for one in slow.findings] == ["depth_held"]
    found = identify(slow, NEEDLE)
    assert not {"lag", "delay"} & {one.name for one in found.estimates} and set(TRUTH) <= set(held(found))


def test_a_depth_in_fine_steps_is_not_taken_for_a_held_one():
    made = trace(noise=0.01)
    assert examine(replace(made, depth=np.round(made.depth / 50e-6) * 50e-6)).findings == ()


def test_a_quiet_force_in_steps_is_not_called_smoothed():
    made = trace(noise=2e-3)
    assert (
        examine(replace(made, force=np.round(made.force / 2e-3) * 2e-3 + 0.3e-3 * (made.depth > 3e-3))).findings == ()
    )

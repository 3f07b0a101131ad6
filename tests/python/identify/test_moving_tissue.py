"""Tissue that breathes or pulses: the model that stands still is doubted, and the motion is named."""

from dataclasses import replace

import numpy as np
import pytest
from punctura.identify import identify
from punctura.identify.doubts import IMPOSSIBLE, doubts
from punctura.identify.fit import Misfit, fit
from punctura.identify.model import Model
from punctura.identify.moving_tissue import moving_tissue
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.identify.search import thinned
from punctura.trace import Finding, Trace, segment
from traces import MEMBRANE, NEEDLE, force_of, motion


def measured(depth, force):
    noise = 8e-3 * np.random.default_rng(4).normal(size=len(depth))
    return Trace(depth, force + noise, np.arange(len(depth)) / 200)


@pytest.mark.parametrize(("size", "rate", "words"), [(400e-6, 0.6, "0.6 times"), (80e-6, 1.2, "1.2 times")])
def test_tissue_that_swings_is_named_with_its_size_and_frequency(size, rate, words):
    time, depth = motion(deepest=12e-3, speed=3e-3, hold=2.0)
    found = identify(measured(depth, force_of(depth + size * np.sin(2 * np.pi * rate * time))), NEEDLE)
    cause, *others = found.doubts.causes
    assert {one.kind for one in others} <= set(IMPOSSIBLE)  # walls that the model then has in air
    assert cause.kind == "moving_tissue" and cause.share > 0.9 and words in cause.text
    told = float(cause.text.partition("forth by ±")[2].partition(" um")[0])
    assert told == pytest.approx(1e6 * size, rel=0.15)


def test_one_or_two_cycles_are_no_breath():
    """6.7 s in tissue: what comes back once or twice may as well be a law that is wrong, or a relaxation."""
    time, depth = motion(deepest=12e-3, speed=3e-3, hold=2.0)
    for rate in (0.15, 0.3):
        assert named(measured(depth, force_of(depth + 400e-6 * np.sin(2 * np.pi * rate * time)))) is None


def test_another_misfit_is_no_motion_of_the_tissue():
    _, depth = motion(deepest=12e-3, speed=3e-3)
    force = force_of(depth)
    found = identify(measured(depth, np.where(force < 0, 2 * force, force)), NEEDLE, 1)
    assert not found.doubts.explained.ok
    assert "moving_tissue" not in [cause.kind for cause in found.doubts.causes]


def named(made):
    """The cause for a trace, beside K06 with one wall, fitted from the truth to the samples of the search."""
    row = default_membrane()
    row[:5] = 5e-3, MEMBRANE.stiffness, MEMBRANE.precompression, MEMBRANE.friction, MEMBRANE.thickness
    start = Parameters(NEEDLE, np.array([row]), default_coupling(4000.0))
    still = fit(Misfit(thinned(made), start), Model(1).names, start)
    assessment = doubts(made, segment(made), fit(Misfit(made, start), Model(1).names, start), ()).explained
    assert not assessment.ok
    return moving_tissue(made, still, still, assessment)


def slow(swing):
    """80 s, 40 samples a second. swing: of the tissue, m, at every time, s."""
    time, depth = motion(deepest=12e-3, speed=0.4e-3, hold=20.0)
    return measured(depth, force_of(depth + swing(time)))[::5]


def test_a_pulse_in_a_long_trace_is_named_although_the_search_uses_few_samples():
    cause = named(slow(lambda time: 80e-6 * np.sin(2 * np.pi * 1.21 * time)))
    assert cause is not None and "1.2 times a second" in cause.text


def test_a_surface_that_moves_one_way_is_no_swing():
    assert named(slow(lambda time: 4e-6 * time)) is None


@pytest.mark.parametrize("kind", ["air_steps", "no_air"])
def test_what_no_motion_of_the_tissue_explains_is_said_beside_it(kind):
    time, depth = motion(deepest=12e-3, speed=3e-3, hold=2.0)
    made = measured(depth, force_of(depth + 400e-6 * np.sin(2 * np.pi * 0.6 * time)))
    found = identify(replace(made, findings=(Finding(kind, "what the air shows"),)), NEEDLE)
    kinds = [cause.kind for cause in found.doubts.causes]
    assert kinds[0] == "moving_tissue" and kind in kinds

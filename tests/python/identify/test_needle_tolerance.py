"""A needle that is stated with a tolerance: the intervals hold the truth also where it is thicker than stated."""

import runpy
from pathlib import Path

import numpy as np
import pytest
import typer
from punctura import Needle
from punctura.cli._rig import rig_of
from punctura.identify import Rig, identify

TOOL = runpy.run_path(str(Path(__file__).parents[3] / "tools" / "try_intervals.py"))
THICKER = 1.04


def held(found, truth):
    known = {one.name: one for one in found.estimates}
    return {name: known[name].low <= value <= known[name].high for name, value in truth.items()}


def test_a_stated_tolerance_reaches_the_intervals():
    trace, needle, truth = TOOL["random_trace"](2, TOOL["Conditions"](machine=True))
    stated = Needle(needle.diameter * THICKER, needle.tip_angle)
    sure = identify(trace, stated, 1)
    found = identify(trace, stated, 1, rig=Rig(diameter_tolerance=1.2 * (THICKER - 1) * needle.diameter))
    assert not all(held(sure, truth).values()) and all(held(found, truth).values())
    for one, other in zip(sure.estimates, found.estimates, strict=True):
        assert other.value == one.value and other.low <= one.low and other.high >= one.high
    (known,) = found.as_dict()["rig"]
    assert (known["name"], known["unit"], known["stated"]) == ("diameter_tolerance", "m", True)


@pytest.mark.parametrize("factor", [0.8, 1.25])
def test_a_needle_that_is_stated_wrongly_is_doubted(factor):
    trace, needle, _ = TOOL["random_trace"](2, TOOL["Conditions"](machine=True))
    stated = Needle(needle.diameter * factor, needle.tip_angle)
    doubts = [one for one in identify(trace, stated, 1).verdicts if "the stated needle" in one]
    assert len(doubts) == 1 and f"{1e3 * factor * tip_of(needle):.3g} mm" in doubts[0]
    assert not any("the stated needle" in one for one in identify(trace, needle, 1).verdicts)


def tip_of(needle):
    return needle.diameter / np.tan(needle.tip_angle)


def test_the_option_states_tolerances():
    rig, needle = rig_of(["depth_noise_um=5"], "diameter_mm=1.27+-0.03, tip_angle_deg=20\u00b11")
    assert needle == "diameter_mm=1.27, tip_angle_deg=20"
    assert rig.diameter_tolerance == pytest.approx(0.03e-3) and rig.depth_noise == pytest.approx(5e-6)
    assert rig.tip_angle_tolerance == pytest.approx(0.0174533, rel=1e-5)
    assert rig_of(None, "") == (Rig(), "")


@pytest.mark.parametrize("given", ["depth_noise_um=-1", "depth_noise_um=nan", "depth_noise=1", "depth_noise_um=x"])
def test_a_wrong_statement_is_named(given):
    with pytest.raises(typer.BadParameter, match="depth_noise_um=10"):
        rig_of([given], "")


@pytest.mark.parametrize("given", ["diameter_mm=1.27+-0.7", "diameter_mm=1.27+-x", "diameter_m=1+-0.1"])
def test_a_wrong_tolerance_is_named(given):
    with pytest.raises(typer.BadParameter, match=r"diameter_mm=1.27\+-0.03"):
        rig_of(None, given)

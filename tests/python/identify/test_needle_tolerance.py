"""A needle that is stated with a tolerance: the intervals hold the truth also where it is thicker than stated."""

import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import typer
from punctura import Needle
from punctura.cli._rig import rig_of
from punctura.errors import ConfigurationError
from punctura.identify import Rig, identify
from punctura.identify.folder import Task, identify_folder
from punctura.identify.intervals import Estimate
from punctura.identify.needle_tolerance import doubt_of_needle, with_tolerance

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


@pytest.mark.parametrize(("share", "doubted"), [(0.999, False), (1.001, True)])
def test_a_tip_at_both_tolerances_is_that_of_the_needle(share, doubted):
    needle, rig = Needle(1.2e-3, 0.4), Rig(diameter_tolerance=0.05e-3, tip_angle_tolerance=0.03)
    longest = (needle.diameter + 0.05e-3) / np.tan(needle.tip_angle - 0.03)
    tip = Estimate("tissue.tip_length", share * longest, share * longest, 2 * longest, "m")
    assert bool(doubt_of_needle([tip], needle, rig)) is doubted


def test_a_bound_widens_also_where_the_other_one_is_not_known():
    trace, needle, _ = TOOL["random_trace"](2, TOOL["Conditions"](machine=True))
    found, rig = identify(trace, needle, 1), Rig(diameter_tolerance=0.03 * needle.diameter)
    both = with_tolerance(found.estimates, found.fit, rig)
    for side in ("low", "high"):
        alone = with_tolerance([replace(one, **{side: None}) for one in found.estimates], found.fit, rig)
        assert alone == tuple(replace(one, **{side: None}) for one in both)


@pytest.mark.parametrize("factor", [0.8, 1.25])
def test_a_needle_that_is_stated_wrongly_is_doubted(factor):
    trace, needle, _ = TOOL["random_trace"](2, TOOL["Conditions"](machine=True))
    stated = Needle(needle.diameter * factor, needle.tip_angle)
    found = identify(trace, stated, 1)
    doubts = [one for one in found.verdicts if "the stated needle" in one]
    assert not found.as_dict()["explained"]["explained"]
    assert len(doubts) == 1 and f"{1e3 * factor * tip_of(needle):.3g} mm" in doubts[0]
    assert not any("the stated needle" in one for one in identify(trace, needle, 1).verdicts)


@pytest.mark.parametrize("wrong", [-1.0, np.nan, np.inf, 2.0])
def test_a_rig_that_cannot_be_is_named_before_the_fit(wrong, tmp_path):
    trace, needle, _ = TOOL["random_trace"](2, TOOL["Conditions"](machine=True))
    rig = Rig(-1e-6 if wrong == 2.0 else wrong, wrong * needle.diameter, wrong * needle.tip_angle)
    for begin in (
        lambda: identify(trace, needle, 1, lambda step: pytest.fail(step), rig),
        lambda: identify_folder(tmp_path, tmp_path / "out", Task(needle, rig=rig)),
    ):
        with pytest.raises(ConfigurationError) as error:
            begin()
        names = [problem.path for problem in error.value.problems]
        assert names == ["rig.depth_noise", "rig.diameter_tolerance", "rig.tip_angle_tolerance"]


def test_a_tolerance_leaves_the_tip_sharp():
    trace, _, _ = TOOL["random_trace"](2, TOOL["Conditions"](machine=True))
    blunt = Needle(1e-3, np.radians(80))
    with pytest.raises(ConfigurationError, match=r"the tip angle, 1.396 rad, between 0 and pi/2"):
        identify(trace, blunt, 1, rig=Rig(tip_angle_tolerance=np.radians(15)))


def tip_of(needle):
    return needle.diameter / np.tan(needle.tip_angle)


def test_the_option_states_tolerances():
    rig, needle = rig_of(["depth_noise_um=5"], "diameter_mm=1.27+-0.03, tip_angle_deg=20\u00b11")
    assert needle == "diameter_mm=1.27, tip_angle_deg=20"
    assert rig.diameter_tolerance == pytest.approx(0.03e-3) and rig.depth_noise == pytest.approx(5e-6)
    assert rig.tip_angle_tolerance == pytest.approx(0.0174533, rel=1e-5)
    assert rig_of(None, "") == (Rig(), "")


@pytest.mark.parametrize("given", ["depth_noise=1", "depth_noise_um=x"])
def test_a_wrong_statement_is_named(given):
    with pytest.raises(typer.BadParameter, match="depth_noise_um=10"):
        rig_of([given], "")


def test_a_statement_without_a_value_is_shown_its_own_example():
    with pytest.raises(typer.BadParameter, match="must be as depth_noise_um=10 or lag_ms=20"):
        rig_of(["depth_noise_um"], "")


@pytest.mark.parametrize("given", ["diameter_mm=1.27+-x", "diameter_m=1+-0.1"])
def test_a_wrong_tolerance_is_named(given):
    with pytest.raises(typer.BadParameter, match=r"diameter_mm=1.27\+-0.03"):
        rig_of(None, given)

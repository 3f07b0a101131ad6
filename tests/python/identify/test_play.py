"""Play of the drive: its way is found at the turns, and told from a delay, whose way depends on the speed."""

import copy
import runpy
from pathlib import Path

import numpy as np
import punctura as pn
import pytest
from punctura.cli._rig import rig_of
from punctura.identify import Rig, identify
from punctura.identify.sensor import played
from punctura.trace import Trace
from traces import MEMBRANE, NEEDLE, RATE, force_of, motion

TOOL = runpy.run_path(str(Path(__file__).parents[3] / "tools" / "try_intervals.py"))
Conditions, random_trace = TOOL["Conditions"], TOOL["random_trace"]
PLAY = 80e-6  # m
TRUTH = {
    "membrane[0].surface": 5e-3, "membrane[0].stiffness": MEMBRANE.stiffness, "coupling_stiffness": 4000.0,
    "membrane[0].precompression": MEMBRANE.precompression, "membrane[0].friction": MEMBRANE.friction,
    "membrane[0].thickness": MEMBRANE.thickness,
}  # fmt: skip


def behind_play(depth, play=PLAY):
    """The depth of the needle, by another way than the model's: it stays until the drive has come back by the play."""
    going = np.arange(len(depth)) <= int(np.argmax(depth))
    return np.where(going, depth, np.minimum(depth + play, depth.max()))


def trace(play=PLAY, seed=1, noise=8e-3, time=True, every=1, **options):
    at, depth = motion(**options)
    force = force_of(behind_play(depth, play)) + noise * np.random.default_rng(seed).normal(size=len(depth))
    return Trace(depth[::every], force[::every], at[::every] if time else None)


def test_the_needle_stays_behind_at_a_turn_and_not_on_the_way_in():
    _, depth = motion()
    assert played(depth, PLAY) == pytest.approx(behind_play(depth), abs=1e-15)
    back_and_forth = np.array([0, 3, 2.5, 2.8, 1, 2.5, 3.5]) * 1e-3
    assert played(back_and_forth, 1e-3) == pytest.approx(np.array([0, 3, 3, 3, 2, 2.5, 3.5]) * 1e-3)
    assert played(depth, 0.0) is depth


@pytest.mark.parametrize("time", [True, False])
@pytest.mark.parametrize("seed", [1, 2])
def test_play_is_found_and_no_wall_and_no_delay_explains_it(seed, time):
    found = identify(trace(seed=seed, time=time), NEEDLE)
    assert len(found.parameters.membranes) == 1 and found.extensions == () and found.doubts.explained.ok
    held = {one.name: one.low <= TRUTH[one.name] <= one.high for one in found.estimates if one.name in TRUTH}
    assert sum(held.values()) >= 5, held
    (play,) = [one for one in found.estimates if one.name in ("lag", "delay", "play")]
    assert play.name == "play" and play.low < PLAY < play.high < 1.3 * play.low
    (known,) = found.as_dict()["rig"]
    assert (known["name"], known["unit"], known["stated"]) == ("play", "m", False)
    (said,) = [one for one in found.verdicts if "had play" in one]
    assert said.startswith("The depth is as if the drive had play") and "um [" in said and "--rig play_um=0" in said
    assert any("a sensor that is late looks as the play" in one for one in found.verdicts) == (not time)


@pytest.mark.parametrize("seed", [1001, 1002])
def test_the_way_of_a_machine_from_sample_to_sample_hides_no_play(seed):
    made, needle, _ = random_trace(seed, Conditions(machine=True, play=PLAY))
    found = identify(made, needle)
    assert found.parameters.late[2] == pytest.approx(PLAY, rel=0.1) and len(found.parameters.membranes) == 1


def test_a_trace_without_play_has_none_and_stated_play_is_used():
    found = identify(trace(play=0.0), NEEDLE)
    assert found.rig == () and found.parameters.late == (0.0, 0.0, 0.0, 0.0)
    stated = identify(trace(), NEEDLE, 1, rig=rig_of(["play_um=80+-5", "lag_ms=0", "delay_ms=0"], "")[0])
    assert [str(one) for one in stated.rig] == ["play 8e-05 m, stated", "play_tolerance 5e-06 m, stated"]
    assert stated.parameters.late[2] == pytest.approx(PLAY) and not any("had play" in one for one in stated.verdicts)
    assert Rig(play=PLAY).values()[0].unit == "m"


@pytest.mark.parametrize("seed", [1, 2])
def test_a_turn_with_few_samples_does_not_tell_play_from_a_late_sensor(seed):
    found = identify(trace(hold=0.0, every=5, seed=seed), NEEDLE)  # 40 Hz, and no rest
    (name,) = {"lag", "delay", "play", "slack"} & {one.name for one in found.estimates}
    (said,) = [one for one in found.verdicts if f"cannot tell the {name} from a" in one]
    assert "play" in said and ("delay" in said or "lag" in said)


@pytest.mark.parametrize("timed", [False, True])
def test_a_late_force_is_a_play_only_without_time_and_that_is_said(timed):
    at, depth = motion(hold=0.0)
    force = np.interp(at - 20e-3, at, force_of(depth)) + 8e-3 * np.random.default_rng(1).normal(size=len(depth))
    found = identify(Trace(depth, force, at if timed else None), NEEDLE, 1)
    late = dict(zip(("lag", "delay", "play", "slack"), found.parameters.late, strict=True))
    if timed:
        assert late["delay"] == pytest.approx(20e-3, abs=2e-3) and late["play"] == late["slack"] == 0
    else:
        assert late["play"] > 0 and any("If it is late, the intervals do not hold" in one for one in found.verdicts)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_noise_of_the_depth_is_no_play(seed):
    made, needle, _ = random_trace(seed, Conditions(machine=True, depth_noise=1e-5))
    for rig in (Rig(), Rig(depth_noise=0.0), Rig(depth_noise=8e-6)):
        assert not {"play", "slack"} & {one.name for one in identify(made, needle, 1, rig=rig).estimates}


def slipping(depth, slack, surface=5e-3):
    """The force that resists insertion (n,), N, of a needle on a slide that moves easily: it lies on the face of its
    drive that the force pushes it to, and between the two faces it is free.
    """
    proxy = pn.Proxy1d(pn.ThickLaw(NEEDLE, MEMBRANE), pn.Coupling(4000.0, 1.0), 1 / RATE)
    found = np.empty(len(depth))
    for i, driven in enumerate(depth - surface):
        for at in np.linspace(driven, driven + slack, 81):  # from the face that pushes to the one that pulls
            moved = copy.copy(proxy)
            force = -float(moved.run(np.array([at])).force[0])
            if force >= 0:
                break
        found[i], proxy = force, moved
    return found


@pytest.mark.parametrize("seed", [1, 2])
def test_play_of_a_slide_that_moves_easily_is_found_where_the_force_changes_its_sign(seed):
    at, depth = motion()
    force = slipping(depth, PLAY) + 8e-3 * np.random.default_rng(seed).normal(size=len(depth))
    found = identify(Trace(depth, force, at), NEEDLE)
    (slack,) = [one for one in found.estimates if one.name in ("lag", "delay", "play", "slack")]
    assert slack.name == "slack" and slack.value == pytest.approx(PLAY, rel=0.1) and slack.high < 1.2 * slack.low
    assert found.parameters.get("coupling_stiffness") == pytest.approx(TRUTH["coupling_stiffness"], rel=0.05)
    assert found.extensions == () and len(found.parameters.membranes) == 1 and found.doubts.explained.ok
    assert any("where the force changes its sign, the needle slips" in one for one in found.verdicts)

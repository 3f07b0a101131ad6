"""Play of the drive: its way is found at the turns, and told from a delay, whose way depends on the speed."""

import numpy as np
import pytest
from punctura.cli._rig import rig_of
from punctura.identify import Rig, identify
from punctura.identify.sensor import played
from punctura.trace import Trace
from traces import MEMBRANE, NEEDLE, force_of, motion

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
    (said,) = [one for one in found.verdicts if "play" in one]
    assert said.startswith("The depth has play") and "um [" in said and "--rig play_um=0" in said


def test_a_trace_without_play_has_none_and_stated_play_is_used():
    found = identify(trace(play=0.0), NEEDLE)
    assert found.rig == () and found.parameters.late == (0.0, 0.0, 0.0)
    stated = identify(trace(), NEEDLE, 1, rig=rig_of(["play_um=80+-5", "lag_ms=0", "delay_ms=0"], "")[0])
    assert [str(one) for one in stated.rig] == ["play 8e-05 m, stated", "play_tolerance 5e-06 m, stated"]
    assert stated.parameters.late[2] == pytest.approx(PLAY) and not any("has play" in one for one in stated.verdicts)
    assert Rig(play=PLAY).values()[0].unit == "m"


@pytest.mark.parametrize("seed", [1, 2])
def test_a_turn_with_few_samples_does_not_tell_play_from_a_delay(seed):
    found = identify(trace(hold=0.0, every=5, seed=seed), NEEDLE)  # 40 Hz, and no rest
    (name,) = {"lag", "delay", "play"} & {one.name for one in found.estimates}
    other = {"delay": "play", "play": "delay"}[name]
    assert any(f"cannot tell the {name} from a {other}" in one for one in found.verdicts)

"""Where a device stands in the scene: files, poses, and the guided command."""

import io
import sys

import numpy as np
import punctura as pn
import pytest
from punctura._core import DeviceError, Placement, SimulatedDevice
from punctura.live import load_placement, placement_from_pose, placement_text, present_pose, run_live
from punctura.live.placement import rotate, shortest_turn
from punctura.simulation import Strokes


def to_scene(p, position, axis):
    turned = rotate(p.rotation, p.scale * np.asarray(position, float))
    b = rotate(p.rotation, np.asarray(axis, float))
    return turned + np.array(p.offset) + p.tip_offset * b, b


def test_the_shortest_turn_takes_one_direction_to_the_other():
    rng = np.random.default_rng(1)
    for _ in range(200):
        a, b = rng.normal(size=(2, 3))
        assert np.allclose(rotate(shortest_turn(a, b), a / np.linalg.norm(a)), b / np.linalg.norm(b))
    for a in np.eye(3):
        assert np.allclose(rotate(shortest_turn(a, -a), a), -a)
        assert np.allclose(rotate(shortest_turn(a, a), a), a)


def test_a_pose_lands_where_the_scene_wants_it():
    rng = np.random.default_rng(2)
    for _ in range(100):
        position, axis, tip, wanted = rng.normal(size=(4, 3))
        p = placement_from_pose(position, axis, tip, wanted, tip_offset=0.03)
        there, b = to_scene(p, position, axis / np.linalg.norm(axis))
        assert np.allclose(there, tip)
        assert np.allclose(b, wanted / np.linalg.norm(wanted))


def test_a_placement_survives_its_file(tmp_path):
    p = Placement((0.1, -0.2, 0.3, 0.9), (0.1, -0.2, 1 / 3), 0.5, 0.017)
    path = tmp_path / "placement.toml"
    path.write_text(placement_text(p))
    back = load_placement(path)
    assert back.rotation == p.rotation and back.scale == p.scale
    assert np.allclose(back.offset, p.offset, rtol=1e-15) and back.tip_offset == pytest.approx(p.tip_offset, rel=1e-15)
    path.write_text("")
    assert load_placement(path) == Placement()


def test_all_that_is_wrong_with_a_file_is_told_at_once(tmp_path):
    path = tmp_path / "placement.toml"
    path.write_text('rotation = [1, 2]\nscale = "big"\noffset = [1, 2, 3]\n')
    with pytest.raises(pn.ConfigurationError) as error:
        load_placement(path)
    assert [p.path for p in error.value.problems] == ["rotation", "scale", "offset"]
    assert [p.reason for p in error.value.problems] == [
        "must be four numbers, [w, x, y, z]", "must be a number", "unknown key; did you mean offset_mm?"
    ]  # fmt: skip
    path.write_text("scale = 0\ntip_offset_mm = inf\n")
    with pytest.raises(pn.ConfigurationError) as error:
        load_placement(path)
    assert [(p.path, p.value) for p in error.value.problems] == [("scale", 0), ("tip_offset_mm", float("inf"))]
    assert str(error.value).startswith(f"{path}: 2 problems")
    path.write_text("scale = \n")
    with pytest.raises(pn.ConfigurationError, match="is not TOML"):
        load_placement(path)


def test_a_run_with_a_placement_meets_the_membrane_where_the_placement_puts_it():
    scene = pn.load_scene("k06-fig10")
    strokes = Strokes([0, 5e-3, 0], [0, -10e-3, 0], count=1, duration=1.0, variation=0.0)

    def deepest(placement):
        device = SimulatedDevice(strokes, real_time=False, ticks=4000)
        return run_live(device, scene, placement=placement).deepest_m[0]

    assert deepest(Placement()) > 5e-3
    assert deepest(Placement(offset=(0, 0.1, 0))) == 0


class LoopWhoseTicksCome:
    """A loop whose state is unknown until the given number of waits."""

    def __init__(self, waits, axis=(0.0, -1.0, 0.0)):
        self.waits = waits
        self.axis = axis
        self.device = self
        self.info = self
        self.has_orientation = True

    def sleep(self, _seconds):
        self.waits -= 1

    def report(self):
        return {"ticks": max(0, 1 - self.waits)}

    def latest(self):
        known = 1.0 if self.report()["ticks"] else 0.0
        return {"position": np.array([[known, 2.0, 3.0]]), "axis": np.array([self.axis]) * known}

    def trouble(self):
        return "unplugged"


def test_a_pose_is_read_only_once_a_tick_has_brought_one():
    loop = LoopWhoseTicksCome(waits=7)
    position, axis = present_pose(loop, sleep=loop.sleep)
    assert position.tolist() == [1, 2, 3]
    assert axis.tolist() == [0, -1, 0]


def test_a_device_that_never_ticks_is_told_with_its_reason():
    loop = LoopWhoseTicksCome(waits=10_000)
    with pytest.raises(DeviceError, match="has not said in 5 s where it is; unplugged"):
        present_pose(loop, sleep=loop.sleep)


def test_a_device_that_points_nowhere_is_reported():
    loop = LoopWhoseTicksCome(waits=0, axis=(0.0, 0.0, 0.0))
    with pytest.raises(DeviceError, match="no place at all"):
        present_pose(loop, sleep=loop.sleep)


@pytest.fixture
def enter(monkeypatch):
    """Standard input holds one line: the Enter key."""
    monkeypatch.setattr(sys, "stdin", io.StringIO("\n"))


def test_place_writes_what_run_takes(punctura, enter, tmp_path):
    out = tmp_path / "here.toml"
    done = punctura("place", "--out", out, "--device", "simulated")
    assert done.status == 0, done.stderr
    assert "20 mm in front of 'thin membrane'" in done.stdout
    placement = load_placement(out)
    # The simulated hand rests 5 mm above the surface, pointing in: it is taken 15 mm higher, and not turned.
    assert placement.offset[1] == pytest.approx(15e-3, abs=1e-3)
    assert placement.rotation == pytest.approx((1, 0, 0, 0))


def test_place_without_an_answer_writes_nothing_and_says_so(punctura, monkeypatch, tmp_path):
    monkeypatch.setattr(sys, "stdin", io.StringIO(""))
    done = punctura("place", "--out", tmp_path / "here.toml", "--device", "simulated")
    assert done.status == 1 and "ended before Enter was pressed" in done.stderr and "Abort" not in done.stderr
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--device", "replay:x.parquet"), "has no hand that holds a pose"),
        (("--out", "nowhere/p.toml"), "there is no folder nowhere; make it first"),
        (("--tip-offset-mm", "nan"), "finite"),
    ],
)
def test_place_says_what_cannot_be_before_anybody_holds_anything(punctura, enter, arguments, words):
    done = punctura("place", "--device", "simulated", *arguments)
    assert done.status == 2 and words in " ".join(done.stderr.split())
    assert "Hold the stylus" not in done.stdout

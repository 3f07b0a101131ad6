"""Snapshots become frames: no tick is lost, and missing ticks are counted. The curves of the laws."""

import math
from itertools import pairwise

import numpy as np
import punctura as pn
import pytest
from punctura._core import ServoLoop, SimulatedDevice
from punctura.simulation import Strokes
from punctura.studio.followers import OtherSolver
from punctura.studio.pump import MOST_TICKS, Pump
from punctura.studio.view import law_curves, obliquities
from punctura.studio.wire import decode_ticks
from waiting import wait_until

SCENE = pn.load_scene("k06-fig12")
STROKES = Strokes([0, 5e-3, 0], [0, -20e-3, 0], count=1, duration=1.0, variation=0.0)


class Out:
    def __init__(self):
        self.all = []

    def frame(self, data):
        self.all.append(decode_ticks(data))

    def send(self, message):
        self.all.append(message)

    @property
    def frames(self):
        return [f for f in self.all if hasattr(f, "ticks")]


class Run:
    """A finished run whose ticks are returned in batches."""

    def __init__(self, ticks=5000):
        self.number, self.rate = 3, 1600.0
        self.pose = ((0.0, 5e-3, 0.0), (0.0, -1.0, 0.0))
        self.loop = ServoLoop(SimulatedDevice(STROKES, real_time=False, ticks=ticks), SCENE)
        listener = self.loop.listen(1 << 14)
        self.loop.arm()
        self.loop.start()
        wait_until(lambda: self.loop.device.finished)
        self.loop.stop()
        self.columns = listener.read()
        self.batches = []

    def give(self, *rows):
        self.batches.append(self.columns[np.r_[rows]])

    def read(self, most=None):
        return self.batches.pop(0) if self.batches else self.columns[:0]


@pytest.fixture
def run():
    return Run()


def test_every_tick_goes_out_once_however_the_ring_is_read(run):
    out = Out()
    pump = Pump(run, out)
    edges = [0, 1, 2, 29, 30, 700, 4999, 5000]
    for start, end in pairwise(edges):
        run.give(slice(start, end))
        pump.turn()
    assert pump.turn() is None
    tick = np.concatenate([f.first_tick + np.arange(len(f)) for f in out.frames])
    assert np.array_equal(tick, np.arange(5000)) and pump.lost == 0
    assert max(len(f) for f in out.frames) <= MOST_TICKS
    force = np.concatenate([f.ticks.force for f in out.frames])
    assert np.array_equal(force.astype(np.float32), run.columns["force"].astype(np.float32))
    kinds = [m.what for m in out.all if getattr(m, "kind", "") == "event"]
    assert kinds.count("pop") == 2 and kinds[0] == "touch"


def test_a_gap_splits_a_frame_and_is_counted(run):
    out = Out()
    pump = Pump(run, out)
    run.give(slice(0, 10), slice(15, 20))
    run.give(slice(40, 50))
    pump.turn()
    pump.turn()
    assert [(f.first_tick, len(f), f.lost) for f in out.frames] == [(0, 10, 0), (15, 5, 5), (40, 10, 25)]
    assert pump.lost == 25 and {f.run for f in out.frames} == {3}


def test_a_changed_scene_is_told_between_its_ticks_and_those_before(run):
    out = Out()
    pump = Pump(run, out)
    run.columns["commands"][7] |= 8
    for name in ("depth", "axial_force", "lower", "upper", "proxy", "direction"):
        run.columns[name][:7, 1] = np.nan  # the scene before had one membrane
    run.give(slice(0, 20))
    pump.change(SCENE, lambda: out.send("the scene"))
    assert [x if isinstance(x, str) else len(x) for x in out.all[:3]] == [7, "the scene", 13]
    assert [f.membranes for f in out.frames] == [1, 2]


def test_a_change_that_no_tick_takes_is_told_all_the_same(run):
    out = Out()
    Pump(run, out).change(SCENE, lambda: out.send("the scene"))
    assert out.all == ["the scene"]


def test_the_other_solver_waits_until_the_tip_is_outside_and_is_then_the_model_alone(run):
    exact = OtherSolver(SCENE.replace(servo=SCENE.servo.replace(solver="paper")))  # whose other one is exact
    inside = int(np.flatnonzero((run.columns["phase"] != 0).any(axis=1))[0]) + 5
    part = lambda a, b: run.columns[a:b]  # noqa: E731
    assert np.isnan(exact.run(part(inside, inside + 50))).all()
    outside = int(np.flatnonzero((run.columns["phase"][inside:] == 0).all(axis=1))[0]) + inside
    force = exact.run(part(inside + 50, 5000))
    assert np.isnan(force[: outside - inside - 50]).all() and np.isfinite(force[outside - inside - 50 :]).all()

    exact.take(SCENE.replace(servo=SCENE.servo.replace(solver="paper")))
    assert np.array_equal(exact.run(run.columns), run.columns["model_force"])


def test_the_other_solver_forgets_what_a_fault_has_broken(run):
    run.columns["position"][100] = np.nan
    run.columns["fault"][100:110] = 1
    force = OtherSolver(SCENE).run(run.columns)
    assert np.isnan(force[100:110]).all() and np.isfinite(force[110:]).all() and np.isfinite(force[:100]).all()


STEEPEST = math.radians(85)
THIN = pn.load_scene("k06-fig10")


@pytest.mark.parametrize("name", pn.scene_names())
@pytest.mark.parametrize("obliquity", [0.0, 0.7, STEEPEST])
def test_a_curve_is_the_law_at_every_point_and_has_its_extremes(name, obliquity):
    scene = pn.load_scene(name)
    for placed, curve in zip(scene.membranes, law_curves(scene, [obliquity] * len(scene.membranes)), strict=True):
        law = pn.TissueLaw(scene.needle, placed.membrane, placed.tissue or pn.Tissue(), obliquity)
        lower, upper = law.bounds(np.array(curve.depth))
        assert np.array_equal(curve.lower, lower) and np.array_equal(curve.upper, upper)
        assert np.all(np.diff(curve.depth) > 0) and curve.depth[0] < 0 < curve.through < curve.depth[-1]
        fine = law.bounds(np.linspace(0, curve.through, 20001))[0]
        assert min(curve.lower) == pytest.approx(float(fine.min()), rel=1e-3)


def test_the_drop_of_a_thin_membrane_is_a_step():
    membrane = pn.Membrane(570, 0.41, 0.2, 0.0)
    scene = THIN.replace(membranes=[pn.PlacedMembrane("thin", membrane, [0, 0, 0], [0, -1, 0])])
    (curve,) = law_curves(scene, [0.0])
    drop = np.diff(curve.lower)
    assert drop.max() > 0.2 and np.diff(curve.depth)[int(np.argmax(drop))] < 1e-15


def test_the_angle_is_that_of_the_stylus_or_of_the_way_the_needle_came_in():
    normal = np.array([0.0, -1.0, 0.0])
    slanted = np.array([1.0, -1.0, 0.0])
    assert obliquities(THIN, slanted) == pytest.approx([math.pi / 4])
    assert obliquities(THIN, slanted * 7, np.array([normal])) == pytest.approx([0.0])
    assert obliquities(THIN, slanted, np.full((1, 3), np.nan)) == pytest.approx([math.pi / 4])
    assert obliquities(THIN.replace(direction="motion"), slanted) == pytest.approx([0.0])
    assert obliquities(THIN, -normal) == pytest.approx([STEEPEST])
    assert obliquities(THIN, np.zeros(3)) == pytest.approx([0.0])

"""The decimated trace for the drawing of a result: small, with all peaks and pops."""

from types import SimpleNamespace

import numpy as np
import punctura as pn
import pytest
from attempts import as_a_device_runs_it, motion_of
from punctura._core import SimulatedDevice, tip_length
from punctura.events import find_events, finder
from punctura.events.finder import recorded_ticks
from punctura.exercise import load_exercise, score
from punctura.exercise.ticks import Geometry, judged_depth
from punctura.record import open_recording
from punctura.studio import recorded as trace
from punctura.studio.recorded import MOST, thinned_trace
from recorded import recorded

SECONDS = 39  # 62,400 ticks: all fit into the ring, however late its reader is


@pytest.fixture(scope="module")
def minute(tmp_path_factory):
    """Into the vein, out and in again, then at rest: 39 s at 1600 Hz."""
    exercise = load_exercise("venipuncture")
    axis = np.asarray(exercise.start_axis)
    legs = [(2.0, 0.0), (4.0, 27.8), (2.0, 0.0), (4.0, 27.8), (SECONDS - 12.0, 27.8)]
    ticks = SECONDS * 1600
    device = SimulatedDevice(motion_of(exercise, legs, axis), real_time=False, ticks=ticks, axis=axis)
    path = tmp_path_factory.mktemp("trace") / "run.parquet"
    return open_recording(recorded(path, device, as_a_device_runs_it(exercise.scene), ticks))


@pytest.fixture(scope="module")
def full(minute):
    """Time and resistance of every tick."""
    parts = [columns for columns, _ in recorded_ticks(minute)]
    time = np.concatenate([part["time"] for part in parts])
    return time, np.concatenate([trace.resistance(part["model_force"], part["axis"]) for part in parts])


def drawn(recording, **asked):
    told = thinned_trace(recording, **asked)
    return tuple(np.array([np.nan if v is None else v for v in row]) for row in (told.time, told.depth, told.force))


@pytest.mark.parametrize("points", [60, 2400, MOST])
def test_a_long_run_at_full_rate_takes_less_than_100_kb(minute, points):
    assert minute.rows == SECONDS * 1600
    size = len(thinned_trace(minute, points=points).model_dump_json())
    assert size < 100_000
    time, _, _ = drawn(minute, points=points)
    assert len(time) <= points + 20 * 6
    assert (np.diff(time) > 0).all() and time[-1] == pytest.approx(SECONDS, abs=1e-2)


@pytest.mark.parametrize("points", [60, 2400])
def test_every_peak_and_every_drop_of_a_pop_survives(minute, full, points):
    events = find_events(minute)
    assert [e.name for e in events if e.what == "pop"] == 2 * ["skin", "front vein wall"]
    few, many = drawn(minute, points=points)[::2], full
    for k, pop in enumerate(events):
        if pop.what != "pop":
            continue
        since, until = events[k - 1].time, events[k + 1].time if k + 1 < len(events) else SECONDS
        peaks, drops = [], []
        for time, force in (few, many):
            at = int(np.abs(time - pop.time).argmin())
            assert time[at] == pytest.approx(pop.time, abs=1e-5)
            peaks.append(force[(time > since + 1e-5) & (time <= pop.time + 1e-5)].max())
            drops.append(peaks[-1] - force[(time >= pop.time - 1e-5) & (time < until - 1e-5)].min())
        assert peaks[0] == pytest.approx(peaks[1], abs=1e-5), pop
        assert drops[0] == pytest.approx(drops[1], abs=2e-5) and drops[1] > 0.1, pop


def test_the_greatest_force_is_the_peak_force_of_the_result(minute):
    result = score(minute.path, "venipuncture")
    time, _, force = drawn(minute)
    touch = result.events[0].time
    within = time <= touch + result.metrics.total_time + 1e-5
    assert force[within].max() == pytest.approx(result.metrics.peak_force, abs=1e-5)


def test_the_drawing_may_begin_later_and_has_then_more_of_the_rest(minute):
    time, _, _ = drawn(minute, start=30.0)
    assert 30.0 <= time[0] < 30.01 and 600 < len(time) <= 2400
    assert len(drawn(minute, start=1e9)[0]) == 0


def test_the_judged_depth_is_behind_a_wall_when_the_verdict_has_the_point_there(minute):
    exercise = load_exercise("venipuncture")
    scene, before = exercise.scene, exercise.space[0]
    geometry = Geometry(scene)
    pushed = 0
    for columns, _ in recorded_ticks(minute):
        ticks = geometry.ticks(columns)
        depth = judged_depth(scene, geometry, ticks, before)
        tip = scene.membranes[0].point[1] - columns["tip"][:, 1]
        for i, placed in enumerate(scene.membranes):
            far = scene.membranes[0].point[1] - placed.point[1] + placed.membrane.thickness
            passed = ticks.past[:, i] > 0
            assert (depth[passed] >= far - 1e-12).all() and (depth[~passed] <= far + 1e-12).all()
            pushed += int((tip[~passed] > far).sum())
    assert pushed > 100  # ticks in which the device's tip is behind a wall that it only pushes ahead
    told = thinned_trace(minute, before=before)
    assert told.tip == pytest.approx(tip_length(scene.needle) * np.sin(np.radians(30)), rel=0.02)
    assert told.depth != thinned_trace(minute).depth
    assert thinned_trace(minute, before=99).depth == thinned_trace(minute).depth  # of an exercise in another scene


def of_columns(monkeypatch, columns, **asked):
    """The trace of these columns instead of those of a recording."""
    monkeypatch.setattr(finder, "recorded_ticks", lambda recording: [(columns, None)])
    summary = SimpleNamespace(first_tick=int(columns["tick"][0]))
    info = SimpleNamespace(scene=pn.load_scene("k06-fig10"), rivals=[])
    return thinned_trace(SimpleNamespace(info=info, rows=len(columns["tick"]), summary=summary), **asked)


def columns_of(tick, tip, force):
    n = len(tick)
    return {
        "tick": tick, "time": tick / 1600, "tip": tip, "axis": np.tile([0.0, -1.0, 0.0], (n, 1)), "model_force": force,
        "depth": np.full((n, 1), -1e-3), "phase": np.zeros((n, 1), np.uint8), "axial_force": np.zeros((n, 1)),
    }  # fmt: skip


@pytest.mark.parametrize("points", [2400, MOST])
def test_the_worst_minute_takes_less_than_100_kb_too(monkeypatch, points):
    """Noise after hours of a run: the largest possible trace, with all digits."""
    random, n = np.random.default_rng(1), SECONDS * 1600
    tick = 1600 * 36_000 + np.arange(n)
    told = of_columns(
        monkeypatch, columns_of(tick, random.normal(0, 0.1, (n, 3)), random.normal(0, 20, (n, 3))), points=points
    )
    assert 0.8 * points < len(told.time) <= points
    assert len(told.model_dump_json()) < 100_000


def test_missing_ticks_and_numbers_break_the_curves(monkeypatch):
    tick = np.concatenate([np.arange(1000), np.arange(1500, 2500)])
    columns = columns_of(tick, np.zeros((2000, 3)), np.zeros((2000, 3)))
    columns["model_force"][1700:1710] = np.nan
    told = of_columns(monkeypatch, columns, points=120)
    broken = [time for time, depth in zip(told.time, told.depth, strict=True) if depth is None]
    assert broken == [pytest.approx(1500 / 1600, abs=1e-5)]


def test_force_has_the_sign_of_what_it_does_to_the_needle():
    axis = np.tile([0.0, -1.0, 0.0], (3, 1))
    force = np.array([[0.3, 0.4, 0.0], [0.3, -0.4, 0.0], [0.0, 0.0, 0.0]])
    assert trace.resistance(force, axis) == pytest.approx([0.5, -0.5, 0.0])


def test_the_page_asks_for_it_by_name(served, page):
    assert page.ask(do="start_recording", name="one")["ok"]
    page.wait(lambda n=page.ticks: page.ticks > n + 400)
    assert page.ask(do="stop_recording")["ok"]
    told = page.json("/api/recordings/one/trace?points=60&from=0.1")
    assert told["time"][0] >= 0.1 and told["membranes"][0]["name"] == "first membrane"
    for wrong in ("points=59", "points=3001", "points=x", "from=nan", "from=inf", "from=x", "before=-1", "before=x"):
        assert page.get(f"/api/recordings/one/trace?{wrong}")[0] == 400
    assert page.get("/api/recordings/two/trace")[0] == 404

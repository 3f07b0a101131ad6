"""Runs compared: their numbers against independent calculations, their mean, and a parameter varied, beside a run."""

import csv
import io
import json
import os
import shutil
import subprocess
import sys
import zipfile
from dataclasses import astuple

import numpy as np
import punctura as pn
import pyarrow.parquet as pq
import pytest
from punctura._core import SimulatedDevice
from punctura.compare import Motion, Run, VaryError, compare, recorded_motion, recorded_run, stroke, vary
from punctura.compare.background import LOWEST, NICE
from punctura.compare.bundle import save_bundle
from punctura.compare.worker import Job, Variation, do
from punctura.events import crossing
from punctura.live import stroke_ends
from punctura.record import Recording, RecordingError, open_recording
from punctura.scene import scene_text
from punctura.simulation import Strokes
from recorded import recorded

VALUES = [500.0, 1000.0, 1500.0]
PATH = "membrane[0].stiffness"
SPEED = 10e-3  # m/s


@pytest.fixture(scope="module")
def scene():
    return pn.load_scene("venipuncture")


@pytest.fixture(scope="module")
def runs(scene):
    return list(vary(scene, PATH, VALUES, stroke(scene, SPEED)))


def test_a_runs_numbers_are_those_of_its_ticks(scene):
    motion = stroke(scene, SPEED)
    ticks = pn.simulate(scene, motion.position, time=motion.time, axis=motion.axis)
    ticks = ticks.replace(axis=np.broadcast_to(motion.axis, (len(ticks), 3)))
    found = compare([Run.of_ticks("one", scene, ticks)]).statistics[0]
    size = np.linalg.norm(ticks.force, axis=1)
    assert found.peak == pytest.approx(size.max())
    assert found.felt_peak is None and found.felt_work is None and {pop.felt_drop for pop in found.pops} == {None}
    deepest = motion.position @ motion.axis - np.asarray(scene.membranes[0].point) @ motion.axis
    assert found.depth == pytest.approx(deepest.max(), abs=1e-4)  # the model filters the measured position
    inside = slice(int(np.argmax(deepest > 0)), int(np.argmax(deepest)))
    assert found.work == pytest.approx(float((size[inside] * np.diff(deepest)[inside]).sum()), rel=0.02)
    assert [pop.name for pop in found.pops] == ["skin", "front vein wall", "back vein wall"]


def test_the_work_counts_only_the_force_along_the_needle(scene):
    # The needle is slanted and moves aside while it goes in, so that the coupling pushes across its axis too.
    axis = np.array([0.3, -1.0, 0.0]) / np.hypot(0.3, 1.0)
    time = np.arange(0, 1.5, 1 / scene.servo.rate)
    position = np.array([0.0, 2e-3, 0.0]) + 8e-3 * time[:, None] * axis
    position[:, 2] += 4e-3 * time * np.clip(time - 0.3, 0, None)
    ticks = pn.simulate(scene, position, time=time, axis=axis)
    ticks = ticks.replace(axis=np.broadcast_to(axis, (len(ticks), 3)))
    run = Run.of_ticks("slanted", scene, ticks)
    tip = ticks.tip if "tip" in ticks else ticks.position
    rows = slice(run.touch, run.touch + int(np.argmax(run.depth[run.touch : run.out])) + 1)
    along = np.diff(tip @ axis, prepend=tip[0] @ axis)
    work = -float(((ticks.force @ axis) * along)[rows].sum())
    norm = float((np.linalg.norm(ticks.force, axis=1) * along)[rows].sum())
    assert compare([run]).statistics[0].work == pytest.approx(work) and norm > 1.01 * work > 0


def test_the_overshoot_is_the_way_that_the_tip_went_on_after_the_pop(scene, runs):
    for value, run in zip(VALUES, runs, strict=True):
        pop = compare([run]).statistics[0].pops[0]
        law = crossing(scene.with_values({PATH: value}), 0, 1.0)
        # For 0.3 s the tip goes on at SPEED; at the pop itself it was ahead of the law by the coupling's give.
        give = pop.drop / scene.coupling.stiffness + law.shaft / scene.coupling.stiffness
        assert 0.3 * SPEED - give - 0.1e-3 < pop.overshoot < 0.3 * SPEED + give + 0.1e-3


def test_the_work_is_that_of_the_first_insertion_only(scene):
    once = stroke(scene, SPEED)
    twice = Motion("twice", np.arange(2 * len(once.time)) / 1600, np.tile(once.position, (2, 1)), once.axis)
    first, second = (compare(vary(scene, PATH, [500.0], motion)).statistics[0] for motion in (once, twice))
    assert len(second.pops) == 2 * len(first.pops)
    assert second.work == pytest.approx(first.work, rel=1e-6)


def test_mean_and_deviation_are_those_of_the_runs_at_each_place(runs):
    for on in ("depth", "time"):
        comparison = compare(runs, on)
        assert len(comparison.membranes) == 3
        for band in (*comparison.bands.values(), *comparison.membranes):
            whole = band.count == len(runs)
            assert np.allclose(band.mean[whole], band.runs[:, whole].mean(axis=0))
            assert np.allclose(band.deviation[whole], band.runs[:, whole].std(axis=0, ddof=1))
            assert np.isnan(band.deviation[band.count < 2]).all()
            places = [slice(*np.flatnonzero(band.count == n)[[0, -1]] + [0, 1]) for n in (3, 2) if n in band.count]
            assert band.stretches == sorted(places, key=lambda place: place.start)
    peaks = [one.peak for one in compare(runs).statistics]
    summary = compare(runs).summary()["peak"]
    assert astuple(summary) == (3, pytest.approx(np.mean(peaks)), pytest.approx(np.std(peaks, ddof=1)))


def test_against_depth_a_curve_has_the_value_of_the_first_passage(runs):
    run, band = runs[0], compare(runs[:1]).bands["model"]
    for k in (50, 200, 350):
        first = int(np.argmax(run.depth >= band.x[k]))
        low, high = sorted(run.model[first - 1 : first + 1])
        assert low - 1e-3 <= band.runs[0, k] <= high + 1e-3


def test_runs_with_different_membranes_have_no_curves_for_each_membrane(runs):
    other = list(vary(pn.load_scene("k06-fig10"), PATH, [300.0]))
    comparison = compare([runs[0], *other])
    assert comparison.membranes == [] and len(comparison.statistics) == 2
    first, second = comparison.statistics
    assert comparison.difference(1)["peak"] == second.peak - first.peak


def test_ticks_are_refused_with_the_way_to_make_a_run(scene):
    ticks = pn.simulate(scene, np.linspace(0, 5e-3, 20))
    with pytest.raises(TypeError, match=r"must be a Run, not Ticks; Run.of_ticks"):
        compare([ticks])


@pytest.mark.parametrize(
    "path, values, words",
    [
        ("membrane[9].stiffness", [1.0], "no field"),
        (PATH, [-5.0], "stiffness"),
        (PATH, [], "1 to 25 runs"),
        (PATH, [500.0] * 26, "1 to 25 runs"),
    ],
)
def test_a_variation_that_is_not_possible_is_refused_before_the_first_run(scene, path, values, words):
    with pytest.raises(VaryError, match=words):
        vary(scene, path, values)


def test_a_variation_that_would_take_too_long_is_refused(scene):
    with pytest.raises(VaryError, match="at most 600 s"):
        vary(scene, PATH, [500.0] * 25, stroke(scene, 1e-3))
    with pytest.raises(ValueError, match="takes more than"):
        stroke(scene, 1e-4)


@pytest.fixture(scope="module")
def recording(tmp_path_factory, scene):
    start, end = stroke_ends(scene)
    device = SimulatedDevice(Strokes(start, end, count=1, duration=1.5), real_time=False, ticks=5000)
    return recorded(tmp_path_factory.mktemp("compare") / "run one.parquet", device, scene, 5000)


def test_a_recording_is_compared_by_what_its_device_gave(recording):
    run = recorded_run(recording)
    ticks = open_recording(recording).ticks()
    assert run.name == "run one" and len(run.time) == len(ticks)
    assert np.abs(run.felt).max() == pytest.approx(float(np.linalg.norm(ticks.force, axis=1).max()), rel=1e-6)
    assert np.nanmax(run.force_limit) == pytest.approx(float(np.nanmax(ticks.ceiling)), rel=1e-6)


def test_the_motion_of_a_recording_moves_another_scene(recording, scene):
    motion = recorded_motion(open_recording(recording))
    assert motion.seconds > 0
    soft, hard = (one.model.max() for one in vary(scene, PATH, [300.0, 3000.0], motion))
    assert 0 < soft < hard


@pytest.mark.parametrize("when", ["opened", "read"])
@pytest.mark.parametrize("job", ["runs", "zip", "motion"])
def test_a_recording_that_is_finished_while_a_job_reads_it_is_read_all_the_same(
    tmp_path, recording, scene, monkeypatch, when, job
):
    part, whole = tmp_path / "one.parquet.part", tmp_path / "one.parquet"
    if when == "opened":  # before the worker opens it, its .part file ends
        shutil.copy(recording, whole)
    else:
        shutil.copy(recording, part)
        batches = Recording.batches

        def just_before(self, progress=None):
            if self.path == part:
                part.replace(whole)
            return batches(self, progress)

        monkeypatch.setattr(Recording, "batches", just_before)
    runs = [("one", str(part))]
    if job == "runs":
        assert do(Job(recordings=runs), lambda line: None).statistics[0].name == "one"
    elif job == "zip":
        assert do(Job(recordings=runs, zip=str(tmp_path / "one.zip")), lambda line: None) is None
        assert (tmp_path / "one.zip").exists()
    else:
        moved = Variation(scene=scene_text(scene), path=PATH, values=[300.0], recording=str(part))
        assert len(do(Job(variation=moved), lambda line: None).statistics) == 1
    assert whole.exists() and not part.exists()


def test_a_recording_that_is_not_there_is_named(tmp_path):
    with pytest.raises(RecordingError, match=r"one\.parquet\.part: there is no such file"):
        do(Job(recordings=[("one", str(tmp_path / "one.parquet.part"))]), lambda line: None)


def test_the_zip_file_has_figure_data_scenes_and_how_to_cite(tmp_path, runs):
    comparison = save_bundle(runs, tmp_path / "all.zip", "depth", "three walls")
    with zipfile.ZipFile(tmp_path / "all.zip") as archive:
        read = {name: archive.read(name) for name in archive.namelist()}
    assert read["figure.pdf"].startswith(b"%PDF") and b"<svg" in read["figure.svg"]
    rows = csv.DictReader(io.StringIO(read["curves.csv"].decode()))
    means = [float(row["model_force_N_mean"] or "nan") for row in rows]
    assert np.allclose(means, comparison.bands["model"].mean, equal_nan=True)
    ticks = pq.read_table(io.BytesIO(read["runs/02.parquet"]))
    assert np.array_equal(ticks["model_force_N"], runs[1].model)
    assert "force_limit_N" in ticks.column_names and b",force_limit_N_mean," in read["curves.csv"]
    (tmp_path / "again.toml").write_bytes(read["scenes/02.toml"])
    assert pn.load_scene(str(tmp_path / "again.toml")).membranes[0].membrane.stiffness == VALUES[1]
    assert pn.__version__ in read["README.txt"].decode() and b"cff-version" in read["CITATION.cff"]


def test_a_recording_that_is_too_long_for_a_motion_is_refused_before_it_is_read(recording, monkeypatch):
    opened = open_recording(recording)
    monkeypatch.setattr(opened, "batches", lambda *_: pytest.fail("it was read"))
    with monkeypatch.context() as patched, pytest.raises(ValueError, match="longer than 1 s; choose a shorter"):
        patched.setattr("punctura.compare.motion.LONGEST_S", 1.0)
        recorded_motion(opened)
    with monkeypatch.context() as patched, pytest.raises(ValueError, match="5000 ticks; the limit is 4999"):
        patched.setattr("punctura.compare.motion.MOST_TICKS", 4999)
        recorded_motion(opened)


@pytest.mark.parametrize(
    "name, limit, words",
    [("MOST_TICKS_IN_ALL", 100, "at most 100: choose fewer"), ("BYTES_A_NUMBER", 10**12, "MB are free: make room")],
)
def test_a_zip_file_that_cannot_be_written_leaves_the_earlier_one_as_it_was(
    tmp_path, runs, monkeypatch, name, limit, words
):
    (tmp_path / "all.zip").write_bytes(b"the earlier file")
    monkeypatch.setattr(f"punctura.compare.bundle.{name}", limit)
    with pytest.raises(ValueError, match=words):
        save_bundle(runs, tmp_path / "all.zip")
    assert [path.name for path in tmp_path.iterdir()] == ["all.zip"]
    assert (tmp_path / "all.zip").read_bytes() == b"the earlier file"


def test_the_worker_tells_its_progress_and_its_result_or_the_reason(scene):
    def answer(**variation):
        job = {"variation": {"scene": scene_text(scene), "path": PATH, "values": VALUES, **variation}}
        command = [sys.executable, "-m", "punctura.compare.worker"]
        done = subprocess.run(command, input=json.dumps(job), capture_output=True, text=True, check=True)
        return [json.loads(line) for line in done.stdout.splitlines()]

    *shares, last = answer()
    assert [one["share"] for one in shares] == pytest.approx([0, 1 / 3, 2 / 3])
    result = last["comparison"]
    assert len(result["statistics"]) == 3 and len(result["depth"]["membranes"]) == 3
    assert result["time"]["bands"]["depth"]["count"][0] == 3
    assert "no field" in answer(path="nothing")[-1]["error"]


PROGRAM = f"""
import os
from punctura.compare.background import step_back
print(max(os.nice(0), 0))
os.environ[{NICE!r}] = "0"
step_back()
print(os.nice(0))
os.environ[{NICE!r}] = "much"
step_back()
print(os.nice(0))
"""


def test_a_computation_gets_the_lowest_priority_or_the_one_that_is_asked_for():
    ran = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True)
    before, asked, lowest = map(int, ran.stdout.split())
    assert (asked, lowest) == (before, LOWEST)


SESSION = """
import subprocess, sys
subprocess.run([sys.executable, "-c", "from punctura.compare.background import step_back; step_back()"], check=True)
print(open("/proc/self/autogroup").read())
"""


@pytest.mark.skipif(not os.path.exists("/proc/self/autogroup"), reason="only Linux schedules by sessions")
def test_the_other_programs_of_its_terminal_keep_their_priority():
    ran = subprocess.run(
        [sys.executable, "-c", SESSION], capture_output=True, text=True, check=True, start_new_session=True
    )
    assert ran.stdout.split()[-1] == "0"

"""A folder of traces: broken files, resuming, the population; the report and the plan of the next experiment."""

import json
import multiprocessing
import os
import signal
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import punctura
import pyarrow.parquet as pq
import pytest
from dying import dies, goes_on, holds_ctrl_c
from punctura.identify import folder as folder_module
from punctura.identify import identify
from punctura.identify.folder import Task, identify_folder
from punctura.identify.plan import information, plans
from punctura.identify.population import drawn_to_mean, population, random_effects
from punctura.identify.report import report_html
from punctura.scene.build import scene_text
from punctura.trace import read_trace
from traces import NEEDLE, trace
from waiting import wait_until

ROW = {"name": "a", "value": 1.0, "low": 0.9, "high": 1.1, "unit": "N"}


@pytest.fixture(scope="module")
def found():
    return identify(trace(noise=0.01, hold=0.2, speed=10e-3), NEEDLE, membranes=1)


def write(path, made):
    table = np.column_stack((made.time, made.depth * 1e3, made.force))
    np.savetxt(path, table, delimiter=",", header="time_s,depth_mm,force_N", comments="")


def test_a_broken_file_does_not_stop_the_others_and_a_second_run_keeps_results(tmp_path):
    folder, out = tmp_path / "traces", tmp_path / "out"
    folder.mkdir()
    for seed in (1, 2):
        write(folder / f"{seed}.csv", trace(noise=0.01, seed=seed, hold=0.2, speed=10e-3))
    (folder / "broken.csv").write_text("time_s,depth_mm,force_N\nx,y,z\n")
    task, heard = Task(NEEDLE, membranes=1), []
    summary = identify_folder(folder, out, task, 1, heard.append)
    assert summary["identified"] == 2 and summary["kept"] == 0 and set(summary["failed"]) == {"broken.csv"}
    assert heard[-1] == 1.0
    rows = pq.read_table(out / "traces.parquet").to_pylist()
    assert {row["trace"] for row in rows} == {"1.csv", "2.csv"}
    assert {row["name"] for row in pq.read_table(out / "population.parquet").to_pylist()} >= {"membrane[0].stiffness"}
    before = (out / "1.csv.json").read_bytes()
    (out / "2.csv.json").write_text("[" * 100_000)  # damaged
    again = identify_folder(folder, out, task, 1)
    assert again["kept"] == 2 and again["identified"] == 2
    assert (out / "1.csv.json").read_bytes() == before
    assert json.loads((out / "2.csv.json").read_bytes())["error"] is None
    with pytest.raises(ValueError, match="holds no trace"):
        identify_folder(tmp_path, out, task)


def test_a_process_that_dies_takes_no_other_trace_with_it_and_is_not_kept(tmp_path, monkeypatch):
    folder, out = tmp_path / "traces", tmp_path / "out"
    folder.mkdir()
    for name in ("dies.csv", "z.csv"):
        (folder / name).write_text("1,2")
    monkeypatch.setattr(folder_module, "_one", dies)
    summary = identify_folder(folder, out, Task(NEEDLE), 1)
    assert "memory" in summary["failed"]["dies.csv"] and summary["failed"]["z.csv"] == "was reached"
    assert {path.name for path in out.glob("*.json")} == {"z.csv.json"}


def _lives(pid):
    """Whether a process lives. Its exit status may be taken by another thread, so it says nothing."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_an_interrupt_does_not_wait_for_the_traces_that_are_computed(tmp_path, monkeypatch):
    folder, out = tmp_path / "traces", tmp_path / "out"
    folder.mkdir()
    for name in ("a.csv", "b.csv", "c.csv"):
        (folder / name).write_text("1,2")

    def interrupted(_):
        raise KeyboardInterrupt

    monkeypatch.setattr(folder_module, "_one", goes_on)
    with pytest.raises(KeyboardInterrupt):
        identify_folder(folder, out, Task(NEEDLE), 2, interrupted)
    # Else the program would wait for them at its end. One that still starts on a busy machine ends a little later.
    wait_until(lambda: not any(_lives(process.pid) for process in multiprocessing.active_children()), 300)
    assert {path.name for path in out.iterdir()} == {"a.csv.json"}


@pytest.mark.skipif(not hasattr(signal, "pthread_sigmask"), reason="Windows has no signal masks")
def test_ctrl_c_while_the_processes_start_is_for_the_program_alone(tmp_path, monkeypatch):
    (tmp_path / "a.csv").write_text("1,2")
    monkeypatch.setattr(folder_module, "_one", holds_ctrl_c)
    summary = identify_folder(tmp_path, tmp_path / "out", Task(NEEDLE), 1)
    assert summary["failed"] == {"a.csv": "held"}
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])


def test_a_file_that_lacks_a_package_is_tried_again_and_another_version_computes_all_again(tmp_path, monkeypatch):
    folder, out = tmp_path / "traces", tmp_path / "out"
    folder.mkdir()
    for name in ("a.mat", "broken.csv"):
        (folder / name).write_text("no table")
    monkeypatch.setitem(sys.modules, "scipy.io", None)
    monkeypatch.setattr(folder_module, "_pool", lambda processes: ThreadPoolExecutor(1))
    summary = identify_folder(folder, out, Task(NEEDLE))
    assert "needs the package scipy" in summary["failed"]["a.mat"] and summary["kept"] == 0
    monkeypatch.undo()
    monkeypatch.setattr(folder_module, "_pool", lambda processes: ThreadPoolExecutor(1))
    summary = identify_folder(folder, out, Task(NEEDLE))
    assert "is no MAT file" in summary["failed"]["a.mat"] and summary["kept"] == 1
    monkeypatch.setattr(punctura, "__version__", "another")
    assert identify_folder(folder, out, Task(NEEDLE))["kept"] == 0


def test_names_that_are_long_or_no_text_are_files_as_others(tmp_path, monkeypatch):
    names = [b"l" * 250 + b".csv", b"n\xe4me.csv"]
    folder = tmp_path / "traces"
    folder.mkdir()
    for name in names:
        (folder / os.fsdecode(name)).write_text("1,2")
    summary = {"error": None, "rmse_N": 0.1, "membranes": 1, "extensions": [], "parameters": [ROW]}
    monkeypatch.setattr(
        folder_module,
        "_computed",
        lambda paths, task, processes: ((path, summary | {"trace": str(path)}, False) for path in paths),
    )
    for _ in range(2):
        assert identify_folder(folder, tmp_path / "out", Task(NEEDLE))["identified"] == 2
    rows = pq.read_table(tmp_path / "out" / "traces.parquet").to_pylist()
    assert {row["trace"] for row in rows} == {names[0].decode(), "n\ufffdme.csv"}
    with pytest.raises(ValueError, match="the results need another folder"):
        identify_folder(folder, folder, Task(NEEDLE))


def test_the_spread_between_traces_is_told_from_their_own_errors():
    rng = np.random.default_rng(6)
    error = rng.uniform(0.5, 1.5, 2000)
    same = 3 + error * rng.normal(size=2000)
    mean, between, _ = random_effects(same, error)
    assert mean == pytest.approx(3, abs=0.1) and between < 0.3
    mean, between, of_mean = random_effects(same + 2 * rng.normal(size=2000), error)
    assert between == pytest.approx(2, rel=0.1) and mean == pytest.approx(3, abs=4 * of_mean)


def test_a_value_with_a_large_error_is_drawn_further_to_the_mean():
    value, error = np.array([0.0, 1, 2, 3, 10, 10]), np.array([0.1, 0.1, 0.1, 0.1, 0.1, 20])
    drawn = drawn_to_mean(value, error)
    assert drawn[4] == pytest.approx(10, abs=0.1) and drawn[5] < 6


def test_the_interval_of_a_mean_of_three_traces_holds_it_as_often_as_it_says():
    rng, held = np.random.default_rng(3), []
    for _ in range(400):
        errors = rng.uniform(0.2, 0.6, 3)
        values = rng.normal(size=3) + errors * rng.normal(size=3)
        rows = [
            ROW | {"value": value, "low": value - 1.96 * error, "high": value + 1.96 * error}
            for value, error in zip(values, errors, strict=True)
        ]
        [summary] = population(rows)
        held.append(summary["low"] < 0 < summary["high"])
    assert 0.93 < np.mean(held) < 0.99  # 0.81 with the normal distribution


def test_a_population_needs_two_traces_with_both_bounds():
    assert population([ROW, ROW | {"low": None}]) == []
    [summary] = population([ROW, ROW | {"value": 2.0, "low": 1.8, "high": 2.2}])
    assert summary["spread_is_relative"] and summary["mean"] == pytest.approx(np.sqrt(2), rel=0.02)


@pytest.mark.skipif(sys.platform != "linux", reason="only here names are bytes")
def test_a_file_whose_name_is_no_text_is_read_and_has_a_scene_and_a_report(found, tmp_path):
    path = tmp_path / os.fsdecode(b"n\xe4me.csv")
    write(path, found.trace)
    read = read_trace(path)
    named = replace(found, trace=read)
    assert "n\ufffdme.csv" in scene_text(named.scene) and "n\ufffdme.csv" in report_html(named).decode()
    json.dumps(named.as_dict()).encode()


def test_the_report_holds_every_parameter_and_verdict(found):
    page = report_html(found).decode()
    assert all(estimate.name in page for estimate in found.estimates)
    assert all(text in page for text in found.verdicts) and "data:image/png" in page


def test_the_plan_is_the_motion_with_the_most_information(found):
    names = [*found.fit.free.names, "tissue.cutting"]
    cut = found.parameters.with_values({"tissue.cutting": 0.05})
    made = plans(cut, names, 12e-3, 0.01)
    assert made[0].score == max(plan.score for plan in made) and made[0].time[-1] <= 60
    assert made[0].depth.max() <= 12e-3 and made[0].csv().startswith(b"time_s,depth_mm\n")
    once, twice = (next(plan for plan in made if ("second" in plan.name) == again) for again in (False, True))
    assert twice.errors["tissue.cutting"] < 0.7 * once.errors["tissue.cutting"]
    score, errors = information(cut, names, twice.time, twice.depth, 0.01)
    assert score == twice.score and errors == twice.errors

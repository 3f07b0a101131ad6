"""punctura study: plans, rows that do not depend on threads or interruptions, and one row again, alone."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from punctura import ConfigurationError
from punctura.record import open_recording
from punctura.study import StudyError, load_plan, replay_row, run_study
from punctura.study.design import design
from punctura.study.folder import Folder, StudyWarning
from punctura.study.run import Forecast
from studies import GRID, in_chunks, with_report, written

SOBOL = """
scene = "k06-fig12"
method = "sobol"
samples = 8
duration_s = 0.15
results = ["peak", "drop[1]"]
[motion]
duration_s = 0.1
rest_s = 0.01
[[variable]]
path = "membrane[0].friction"
low = 0.1
high = 0.3
[[variable]]
path = "membrane[0].stiffness"
distribution = "normal"
mean = 500
sd = 100
low = 300
"""


def test_all_problems_of_a_plan_at_once(tmp_path: Path) -> None:
    text = GRID.replace("chunk = 2", "chunk = 0").replace('"hand.stiffness"', '"hand.grip"')
    with pytest.raises(ConfigurationError) as found:
        load_plan(written(tmp_path, text.replace("values = [0.1, 0.2, 0.3]", "low = 1")))
    paths = {problem.path for problem in found.value.problems}
    assert paths == {"chunk", "variable[0].values", "variable[1].path"}
    with pytest.raises(ConfigurationError, match="power of 2"):
        load_plan(written(tmp_path, SOBOL.replace("samples = 8", "samples = 9")))
    with pytest.raises(ConfigurationError, match="practically no numbers"):
        design(load_plan(written(tmp_path, SOBOL.replace("low = 300", "low = 9000"))))
    with pytest.raises(ConfigurationError, match=r"values\[1\].*must be a finite number"):
        load_plan(written(tmp_path, GRID.replace("[0.1, 0.2, 0.3]", "[0.1, nan, 0.3]")))
    with pytest.raises(ConfigurationError, match=r"variable\[0\]\.low.*must be a finite number"):
        load_plan(written(tmp_path, SOBOL.replace("low = 0.1", "low = nan")))
    with pytest.raises(ConfigurationError, match="duration_s"):
        load_plan(written(tmp_path, GRID.replace("duration_s = 0.3", "duration_s = nan")))
    with pytest.raises(
        ConfigurationError, match=r"duration_s = 0\.0003: is shorter than a tick: .* at least 0\.000625 s"
    ):
        load_plan(written(tmp_path, GRID.replace("duration_s = 0.3", "duration_s = 0.0003")))
    with pytest.raises(ConfigurationError, match="unknown key"):
        load_plan(written(tmp_path, "trials = 3\n" + GRID))
    for message, old, new in [
        ("is also the path of a variable", '"plant.friction" = 0.1', '"hand.stiffness" = 500'),
        ("is an empty list", '["peak", "drop[0]"]', "[]"),
        (r"a result of each membrane: give drop\[0\] or drop\[1\]", '"drop[0]"', '"drop"'),
    ]:
        with pytest.raises(ConfigurationError, match=message):
            load_plan(written(tmp_path, GRID.replace(old, new)))


def test_rows_do_not_depend_on_threads_or_interruptions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plan = load_plan(written(tmp_path, GRID))
    run_study(plan, tmp_path / "one", threads=1)
    save, saved = Folder.save, []

    def interrupted(folder: Folder, number: int, table: object) -> None:
        if number == 1:
            raise KeyboardInterrupt
        saved.append(number)
        save(folder, number, table)

    monkeypatch.setattr(Folder, "save", interrupted)
    with pytest.raises(KeyboardInterrupt):
        run_study(plan, tmp_path / "two", threads=2)
    monkeypatch.undo()
    summary = run_study(plan, tmp_path / "two", threads=2)
    assert (saved, summary.kept, summary.trials) == ([0], 2, 6)
    one, two = (pq.read_table(tmp_path / name / "trials.parquet") for name in ("one", "two"))
    assert one.equals(two) and one["row"].to_pylist() == list(range(6))
    assert one["seed"].to_pylist() == list(range(5, 11))
    assert run_study(plan, tmp_path / "two").kept == 6


def test_a_killed_run_loses_no_row_and_doubles_none(tmp_path: Path) -> None:
    path = written(tmp_path, GRID)
    plan = load_plan(path)
    run_study(plan, tmp_path / "whole", threads=1)
    code = (
        "import os, sys\nfrom punctura.study import load_plan, run_study\nfrom punctura.study.folder import Folder\n"
        "save = Folder.save\n"
        "def dying(self, number, table):\n"
        "    if number == 1: os._exit(9)\n"
        "    save(self, number, table)\n"
        "Folder.save = dying\n"
        "run_study(load_plan(sys.argv[1]), sys.argv[2])"
    )
    killed = subprocess.run([sys.executable, "-c", code, str(path), str(tmp_path / "killed")], check=False)
    assert killed.returncode == 9 and sorted(p.name for p in (tmp_path / "killed").glob("*.parquet")) == [
        "chunk-000000.parquet"
    ]
    assert run_study(plan, tmp_path / "killed").kept == 2
    whole, again = (pq.read_table(tmp_path / name / "trials.parquet") for name in ("whole", "killed"))
    assert again.equals(whole) and again["row"].to_pylist() == list(range(6))


def test_the_first_chunk_tells_how_long_and_how_much_disk_the_others_take(tmp_path: Path) -> None:
    reports: list[Forecast] = []
    shares: list[float] = []
    out = tmp_path / "out"
    run_study(load_plan(written(tmp_path, GRID)), out, progress=shares.append, on_forecast=reports.append)
    assert [one.trials for one in reports] == [4]
    assert reports[0].seconds is not None and 0 < reports[0].seconds < 60 and not reports[0].is_worth_showing
    assert 0.5 * (out / "trials.parquet").stat().st_size < reports[0].bytes < reports[0].free
    assert shares == sorted(shares) and 0 < shares[0] < 0.1 and shares[-1] == 1


def test_a_long_study_and_a_small_disk_are_told() -> None:
    long = Forecast(99_000_000, 25_000.0, 8 * 10**9, 9 * 10**10)
    assert long.is_worth_showing and str(long) == "99000000 trials are left: they need about 6.9 h and 8 GB of disk"
    full = Forecast(10, None, 5 * 10**8, 4 * 10**8)
    assert full.is_worth_showing and "they need 0.5 GB of disk, and 0.4 GB are free: name fewer results" in str(full)


def test_damaged_files_are_computed_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plan = load_plan(written(tmp_path, GRID))
    out = tmp_path / "out"

    def damage(path: Path) -> None:
        data = bytearray(path.read_bytes())
        data[40] ^= 0x10  # in a page; the footer with the number of rows stays readable
        path.write_bytes(data)

    run_study(plan, out)
    whole = pq.read_table(out / "trials.parquet")
    damage(out / "trials.parquet")
    with pytest.warns(StudyWarning, match=r"trials\.parquet is damaged"):
        in_chunks(plan, out, monkeypatch)
    damage(out / "chunk-000001.parquet")
    with pytest.warns(StudyWarning, match=r"chunk-000001\.parquet is damaged"):
        assert run_study(plan, out).kept == 4
    assert pq.read_table(out / "trials.parquet").equals(whole)


def test_the_report_has_pictures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with_report(monkeypatch)
    plan = load_plan(written(tmp_path, GRID))
    run_study(plan, tmp_path / "out")
    report = (tmp_path / "out" / "report.md").read_text()
    assert "![drop[0]](pictures/drop_0.svg)" in report
    points = (tmp_path / "out" / "pictures" / "peak.svg").read_text()
    monkeypatch.setattr("punctura.study.report._MOST_POINTS", 3)
    run_study(plan, tmp_path / "out")
    bands = (tmp_path / "out" / "pictures" / "peak.svg").read_text()
    assert points.startswith("<?xml") and bands != points


def test_a_folder_holds_one_study_and_serves_one_run(tmp_path: Path) -> None:
    plan = load_plan(written(tmp_path, GRID))
    folder = Folder(tmp_path / "out")
    with folder.locked(), pytest.raises(StudyError, match="another run"):
        run_study(plan, tmp_path / "out")
    run_study(plan, tmp_path / "out")
    other = load_plan(written(tmp_path, GRID.replace("seed = 5", "seed = 6")))
    with pytest.raises(StudyError, match="another plan"):
        run_study(other, tmp_path / "out")


def test_a_refused_plan_leaves_its_folder_to_the_mended_one(tmp_path: Path) -> None:
    bad = GRID.replace("0.2, 0.3]", "-0.2, 0.3]", 1)
    with pytest.raises(ConfigurationError, match=r"row 2: membrane\[0\]\.friction = -0\.2"):
        run_study(load_plan(written(tmp_path, bad)), tmp_path / "out")
    assert run_study(load_plan(written(tmp_path, GRID)), tmp_path / "out").trials == 6


def test_a_chunk_with_rows_of_another_one_is_computed_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plan, out = load_plan(written(tmp_path, GRID)), tmp_path / "out"
    in_chunks(plan, out, monkeypatch)
    (out / "chunk-000001.parquet").write_bytes((out / "chunk-000000.parquet").read_bytes())
    with pytest.warns(StudyWarning, match=r"chunk-000001\.parquet is damaged or was changed"):
        assert run_study(plan, out).kept == 4
    assert pq.read_table(out / "trials.parquet")["row"].to_pylist() == list(range(6))


def test_a_missing_package_is_told_without_a_traceback(tmp_path: Path, punctura, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    done = punctura("study", written(tmp_path, GRID), "--scheduler", "tcp://127.0.0.1:1")
    assert done.status == 1 and "Traceback" not in done.stderr
    assert "needs the package distributed, of the extra 'dask'. Install it: " in done.stderr


@pytest.mark.parametrize("blocked", ["out", "out/lock", "out/study.json", "out/pictures"])
def test_a_folder_that_cannot_be_written_is_named_with_what_to_do(
    tmp_path: Path, blocked: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    with_report(monkeypatch)
    place = tmp_path / blocked
    place.parent.mkdir(exist_ok=True)
    if blocked in ("out", "out/pictures"):
        place.write_text("a file, not a folder")
    else:
        place.mkdir()
    with pytest.raises(StudyError, match=rf"{place.name}.*cannot be written \(.*\): give another folder with --out"):
        run_study(load_plan(written(tmp_path, GRID)), tmp_path / "out")


def test_values_of_an_unusual_size_are_warned_of(tmp_path: Path) -> None:
    thick = GRID.replace("membrane[0].friction", "membrane[0].thickness").replace("[0.1, 0.2, 0.3]", "[1, 0.001]")
    plan = load_plan(written(tmp_path, thick))
    with pytest.warns(UserWarning, match="If you meant"):
        run_study(plan, tmp_path / "out")


def test_a_link_named_lock_creates_no_file_elsewhere(tmp_path: Path) -> None:
    folder, elsewhere = tmp_path / "study", tmp_path / "elsewhere"
    folder.mkdir()
    (folder / "lock").symlink_to(elsewhere)
    with pytest.raises(StudyError, match="lock is a symbolic link: delete it"), Folder(folder).locked():
        pass
    assert not elsewhere.exists()


def test_a_row_again_is_the_row(tmp_path: Path, punctura) -> None:
    plan = load_plan(written(tmp_path, GRID))
    run_study(plan, tmp_path / "out")
    table = pq.read_table(tmp_path / "out" / "trials.parquet")
    scene, recording = replay_row(plan, 3, tmp_path / "out")
    assert scene.exists()
    ticks = open_recording(recording).ticks()
    assert np.linalg.norm(ticks.model_force, axis=1).max() == table["peak"][3].as_py()
    with pytest.raises(StudyError, match="no row 6"):
        replay_row(plan, 6, tmp_path / "out")
    assert punctura("study", plan.path, "--replay", "6").status == 2


def test_the_command_writes_sobol_indices(tmp_path: Path, punctura, monkeypatch: pytest.MonkeyPatch) -> None:
    with_report(monkeypatch)
    path = written(tmp_path, SOBOL)
    done = punctura("study", path, "--json", "--workers", "1")
    assert done.status == 0, done.stderr
    reports = json.loads(done.stdout)
    assert reports["trials"] == 32
    table = pq.read_table(reports["table"])
    assert table.column_names == ["row", "membrane[0].friction", "membrane[0].stiffness", "seed", "peak", "drop[1]",
                                  "fault"]  # fmt: skip
    assert min(table["membrane[0].stiffness"].to_pylist()) >= 300
    assert "| peak | membrane[0].stiffness |" in Path(reports["report"]).read_text()

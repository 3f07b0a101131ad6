"""punctura exercise."""

import csv
import json

import numpy as np
import pytest
from attempts import HEAD, as_a_device_runs_it, goal, motion_of
from punctura._core import SimulatedDevice
from punctura.exercise import ResultStore, load_exercise, score
from recorded import recorded


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    exercise = load_exercise("venipuncture")
    axis = np.asarray(exercise.start_axis)
    motion = motion_of(exercise, [(1.0, 0.0), (2.5, 20.0), (2.0, 33.0), (1.0, 33.0)], axis)
    device = SimulatedDevice(motion, real_time=False, ticks=12000, axis=axis)
    path = tmp_path_factory.mktemp("recordings") / "try.parquet"
    return recorded(path, device, as_a_device_runs_it(exercise.scene), 12000)


def test_the_ready_exercises_are_listed(punctura):
    assert "venipuncture      Venipuncture: " in punctura("exercise", "list").stdout
    entries = json.loads(punctura("exercise", "list", "--json").stdout)
    assert [(e["name"], e["scene"]) for e in entries if e["name"] == e["scene"]] == [
        ("venipuncture", "venipuncture"), ("epidural", "epidural"),
    ]  # fmt: skip


def test_a_recording_is_scored(punctura, recording):
    done = punctura("exercise", "score", recording, "--exercise", "venipuncture")
    assert done.status == 0, done.stderr
    assert done.stdout.startswith("Venipuncture: not passed\n  You went through the back vein wall ")
    assert "\n  missed       Do not go through the back vein wall" in done.stdout
    assert "\n  not decided  Bring the whole tip" in done.stdout
    assert "\n  1 entry, model force 0." in done.stdout
    assert " s in the space, at most " in done.stdout
    done = punctura("exercise", "score", recording, "--exercise", "venipuncture", "--person", "Ada", "--json")
    result = json.loads(done.stdout)
    assert (result["passed"], result["person"], result["recording"]) == (False, "Ada", "try")


def test_a_warning_of_the_exercise_is_printed_beside_the_score(punctura, recording, tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(HEAD + goal("reach", depth_mm=2), encoding="utf-8")
    done = punctura("exercise", "score", recording, "--exercise", file)
    assert done.status == 0 and done.stdout.startswith("Test: passed")
    assert done.stderr.startswith(f"punctura: warning: {file}: goal[0]: is met before the front vein wall pops")


def test_what_cannot_be_scored_is_reported(punctura, recording, tmp_path):
    done = punctura("exercise", "score", recording, "--exercise", "epidural")
    assert (done.status, done.stdout) == (2, "")
    assert f"{recording}: 1 problem" in done.stderr
    assert "has no membrane 'ligamentum flavum' and no 'dura', which the exercise needs; it has skin, " in done.stderr
    assert "choose a recording of the exercise epidural (its scene is 'Epidural" in done.stderr
    assert punctura("exercise", "score", tmp_path / "none", "--exercise", "epidural").status == 2
    done = punctura("exercise", "score", recording, "--exercise", "none")
    assert done.status == 2 and "ready exercises: steady-push, stop-after-pop, " in done.stderr
    assert punctura("exercise").status == 2


def test_the_coach_is_printed_with_the_score(punctura, recording):
    printed = punctura("exercise", "score", recording, "--exercise", "venipuncture").stdout
    result = json.loads(punctura("exercise", "score", recording, "--exercise", "venipuncture", "--json").stdout)
    change, good = result["coaching"]["change"], result["coaching"]["good"]
    assert change[0]["about"] == "through" and 0 < change[0]["numbers"]["speed_m_per_s"] < 0.05
    assert f"\n  Next time: {change[0]['text']}\n" in printed and printed.count("  Next time: ") == 1
    assert f"\n  What went well: {good[0]['text']}\n" in printed and printed.count("  What went well: ") == 1


def test_results_are_exported_as_csv_and_as_xapi_statements(punctura, recording, tmp_path, monkeypatch):
    results = ResultStore(tmp_path / "results")
    judged = score(recording, "venipuncture", "Ada")
    for person, group in (("Ada", "9b"), ("Bob", "9b"), ("Cem", "")):
        results.save(judged.model_copy(update={"person": person, "group": group}))
    folder = "--results", results.folder
    rows = list(csv.DictReader(punctura("exercise", "export", "--format", "csv", *folder).stdout.splitlines()))
    assert sorted((row["person"], row["class"]) for row in rows) == [("Ada", "9b"), ("Bob", "9b"), ("Cem", "")]
    lines = punctura("exercise", "export", "--format", "xapi", "--class", "9b", *folder).stdout.splitlines()
    assert sorted(json.loads(line)["actor"]["name"] for line in lines) == ["Ada", "Bob"]
    file = tmp_path / "ada.jsonl"
    more = "--person", "Ada", "--home-page", "https://school.example", "--out", file
    assert punctura("exercise", "export", "--format", "xapi", *more, *folder).stdout == ""
    whole = file.read_text(encoding="utf-8")
    assert json.loads(whole)["actor"]["account"]["homePage"] == "https://school.example"
    monkeypatch.setattr("os.fsync", lambda _: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    assert punctura("exercise", "export", "--format", "csv", "--out", file, *folder).status != 0
    assert file.read_text(encoding="utf-8") == whole  # a full disk leaves the earlier file


def test_a_damaged_result_is_told_and_the_others_are_exported(punctura, recording, tmp_path):
    ResultStore(tmp_path).save(score(recording, "venipuncture", "Ada"))
    (tmp_path / "damaged.json").write_text('{"person": 3}')
    done = punctura("exercise", "export", "--format", "csv", "--results", tmp_path)
    assert done.status == 1 and "Ada" in done.stdout
    assert f"punctura: {tmp_path}: damaged is no result: " in done.stderr and done.stderr.endswith("it is left out\n")
    nobody = punctura("exercise", "export", "--format", "csv", "--results", tmp_path, "--person", "Bob")
    assert f"there are no results of Bob in {tmp_path}" in nobody.stderr


def test_an_export_that_is_not_possible_is_refused(punctura, tmp_path):
    assert "is not one of 'csv', 'xapi'" in punctura("exercise", "export", "--format", "xls").stderr
    wrong = punctura("exercise", "export", "--format", "csv", "--results", tmp_path / "none")
    assert wrong.status == 2 and "does not exist" in " ".join(wrong.stderr.split())
    wrong = punctura("exercise", "export", "--format", "xapi", "--home-page", "school")
    assert wrong.status == 2 and "must begin with http" in wrong.stderr
    wrong = punctura("exercise", "export", "--format", "csv", "--home-page", "http://a")
    assert wrong.status == 2 and "is for --format xapi" in wrong.stderr
    wrong = punctura("exercise", "export", "--format", "csv", "--out", tmp_path / "none" / "a.csv")
    assert wrong.status == 2 and "make it first" in " ".join(wrong.stderr.split())

"""Saved results are found again by person, nothing outside their folder is touched; and results as xAPI statements."""

import csv
import io
import json
import os
import re
import stat
import threading
import uuid

import pytest
from attempts import hand_run, judged, tried
from punctura.exercise import ResultsError, ResultStore, load_exercise
from punctura.exercise.results import COLUMNS, default_folder, to_csv, to_json
from punctura.exercise.xapi import duration, statement, to_xapi
from punctura.studio.experts import Experts
from punctura.studio.shelf import Shelf


@pytest.fixture(scope="module")
def result():
    legs = ((1.0, 0.0), (2.5, 20.0), (4.0, 27.8), (5.0, 27.8))
    return judged(load_exercise("venipuncture"), hand_run("venipuncture", legs)).finish("Ada Lovelace", "run-1")


def of(result, person, date="2026-01-01T10:00:00+00:00"):
    return result.model_copy(update={"person": person, "date": date})


def test_what_was_saved_is_loaded_again(tmp_path, result):
    store = ResultStore(tmp_path / "results")
    kept = store.save(of(result, "Ada Lovelace"))
    assert kept.name.startswith("2026-01-01t10-00-00-venipuncture-ada-lovelace-")
    assert store.load(kept.name) == kept
    assert kept.model_copy(update={"name": ""}) == of(result, "Ada Lovelace")
    assert [path.name for path in (tmp_path / "results").iterdir()] == [f"{kept.name}.json"]


@pytest.mark.skipif(os.name != "posix", reason="modes of files")
def test_the_folder_is_made_for_its_owner_alone(tmp_path, result):
    ResultStore(tmp_path / "results").save(result)
    Shelf(tmp_path / "recordings").file("a run")
    assert {stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("results", "recordings")} == {0o700}


def test_nothing_is_overwritten(tmp_path, result):
    store = ResultStore(tmp_path)
    assert len({store.save(result).name for _ in range(20)}) == 20
    assert len(store.all()) == 20


def test_results_are_found_by_person_the_latest_first(tmp_path, result):
    store = ResultStore(tmp_path)
    for person, day in (("Ada", 1), ("Grace", 3), ("Ada", 2), ("", 4)):
        store.save(of(result, person, f"2026-01-0{day}T10:00:00+00:00"))
    assert [r.date[8:10] for r in store.all()] == ["04", "03", "02", "01"]
    assert [r.date[8:10] for r in store.all("Ada")] == ["02", "01"]
    assert store.all("Nobody") == []
    assert store.people() == ["Ada", "Grace"]


@pytest.mark.parametrize(
    "person",
    ["../../etc/passwd", "..", "/", "a\\b", "con", "  ", "\x00", "漢字", "Zoë Ö", "x" * 80, "a/../../b", "-rf"],
)
def test_a_persons_name_never_leads_out_of_the_folder(tmp_path, result, person):
    folder = tmp_path / "deep" / "results"
    kept = ResultStore(folder).save(of(result, person))
    assert [path.parent for path in tmp_path.rglob("*.json")] == [folder]
    assert ResultStore(folder).load(kept.name).person == person
    assert ResultStore(folder).all(person)[0].name == kept.name


@pytest.mark.parametrize(
    "name", ["", "..", "../x", "x/../../y", "/etc/passwd", "a.json", "A", "a\x00", "a\n", "x" * 200, "C:x", "%2e%2e"]
)
def test_names_that_are_none_are_refused(tmp_path, name):
    (tmp_path.parent / "x.json").write_text("{}")
    store = ResultStore(tmp_path)
    for what in (store.load, store.delete):
        with pytest.raises(ResultsError):
            what(name)


def test_what_is_no_result_is_left_alone(tmp_path, result):
    store = ResultStore(tmp_path)
    kept = store.save(result)
    (tmp_path / "other.json").write_text('{"a": 1}')
    (tmp_path / "broken.json").write_bytes(b"\xff{")
    (tmp_path / "notes.txt").write_text("mine")
    (tmp_path / "folder.json").mkdir()
    outside = tmp_path.parent / "outside.json"
    outside.write_text(kept.model_dump_json())
    (tmp_path / "link.json").symlink_to(outside)
    assert [r.name for r in store.all()] == [kept.name]
    for name in ("other", "broken", "folder", "link", "none"):
        with pytest.raises(ResultsError):
            store.load(name)
    store.delete(kept.name)
    assert store.all() == []
    assert {path.name for path in tmp_path.iterdir()} >= {"other.json", "notes.txt", "link.json"}


def test_a_folder_that_is_not_there_is_empty_and_stays_away(tmp_path):
    store = ResultStore(tmp_path / "none")
    assert (store.all(), store.people()) == ([], [])
    assert not (tmp_path / "none").exists()


def test_results_saved_at_the_same_time_are_all_kept(tmp_path, result):
    store = ResultStore(tmp_path)
    threads = [threading.Thread(target=lambda: [store.save(result) for _ in range(5)]) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(store.all()) == 20
    assert not list(tmp_path.glob("*.part"))


@pytest.mark.skipif(os.name != "posix", reason="other systems have other permissions")
def test_a_result_is_the_persons_own_in_a_shared_folder_too(punctura, tmp_path, result, free_umask):
    tmp_path.chmod(0o777)
    ResultStore(tmp_path).save(result)
    Experts(tmp_path).set("venipuncture", "run")
    punctura("exercise", "export", "--format", "csv", "--results", tmp_path, "--out", tmp_path / "class.csv")
    files = [*tmp_path.iterdir(), tmp_path.parent / f"{tmp_path.name}-experts.json"]
    assert len(files) == 3 and {stat.S_IMODE(file.stat().st_mode) for file in files} == {0o600}


def test_the_table_has_one_row_a_result_in_units_for_people(tmp_path, result):
    rows = list(csv.DictReader(io.StringIO(to_csv([of(result, "Ada"), of(result, "=cmd()")]))))
    assert list(rows[0]) == list(COLUMNS)
    assert (rows[0]["person"], rows[0]["passed"], rows[0]["entries"]) == ("Ada", "yes", "1")
    assert float(rows[0]["peak_force_N"]) == pytest.approx(result.metrics.peak_force, rel=1e-5)
    assert float(rows[0]["entry_angle_deg"]) == pytest.approx(30, abs=0.01)
    largest = max(one.distance for one in result.metrics.overshoot)
    assert float(rows[0]["largest_overshoot_mm"]) == pytest.approx(largest * 1e3, rel=1e-5)
    assert rows[1]["person"] == "'=cmd()"  # no formula for a spreadsheet


def test_the_table_of_a_result_without_metrics_has_empty_cells(result):
    nothing = result.metrics.model_copy(update={"straightness": None, "overshoot": [], "path_length": None})
    row = next(csv.DictReader(io.StringIO(to_csv([result.model_copy(update={"metrics": nothing})]))))
    assert (row["straightness"], row["largest_overshoot_mm"], row["path_length_mm"]) == ("", "", "")


def test_the_json_is_a_list_of_whole_results(result):
    assert json.loads(to_json([result, result])) == [json.loads(result.model_dump_json())] * 2
    assert json.loads(to_json([])) == []


def test_the_usual_folder_is_the_persons_own():
    assert default_folder().name == "results"
    assert "punctura" in str(default_folder())


def test_a_result_of_an_earlier_version_that_counts_attempts_is_read(tmp_path, result):
    store = ResultStore(tmp_path)
    kept = store.save(result)
    path = tmp_path / f"{kept.name}.json"
    path.write_text(path.read_text(encoding="utf-8").replace('"entries"', '"attempts"'), encoding="utf-8")
    assert store.load(kept.name) == kept


WAIT = (1.0, 0.0)
PASSED = tried("venipuncture", WAIT, (2.5, 20.0), (4.0, 27.8), (5.0, 27.8))
FAILED = tried("venipuncture", WAIT, (2.5, 20.0), (2.0, 33.0), (1.0, 33.0))
GIVEN_UP = tried("venipuncture", WAIT, (2.0, 16.0), (2.0, 16.0))


@pytest.mark.parametrize(("result", "verb"), [(PASSED, "passed"), (FAILED, "failed"), (GIVEN_UP, "attempted")])
def test_the_verb_says_how_the_attempt_ended(result, verb):
    record = statement(result)
    assert record["verb"] == {"id": f"http://adlnet.gov/expapi/verbs/{verb}", "display": {"en": verb}}
    assert record["result"].get("success") == {"passed": True, "failed": False, "attempted": None}[verb]
    assert record["result"]["completion"] == (verb != "attempted")


def test_a_statement_has_the_parts_that_the_format_asks_for():
    result = PASSED.model_copy(update={"person": "Ada", "group": "9b", "name": "a-result"})
    record = statement(result, "https://school.example/")
    assert uuid.UUID(record["id"]) and record["version"] == "1.0.3"
    account = {"homePage": "https://school.example", "name": "Ada"}
    assert record["actor"] == {"objectType": "Agent", "name": "Ada", "account": account}
    assert record["object"]["id"] == "https://school.example/exercises/venipuncture"
    assert record["context"]["team"]["account"]["name"] == "9b"
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\+00:00", record["timestamp"])
    assert record["result"]["score"] == {"scaled": 1.0, "raw": 7, "min": 0, "max": 7}
    assert record["result"]["duration"] == duration(result.metrics.total_time)
    forces = [value for key, value in record["result"]["extensions"].items() if key.endswith("/peak_force_N")]
    assert forces == [result.metrics.peak_force]


def test_the_same_result_has_the_same_id_and_another_one_has_another():
    names = [PASSED.model_copy(update={"name": name}) for name in ("a", "a", "b")]
    ids = [statement(result)["id"] for result in names]
    assert ids[0] == ids[1] != ids[2]


def test_a_person_without_a_name_is_anonymous_and_each_statement_is_a_line():
    lines = to_xapi([PASSED, FAILED]).splitlines()
    assert [json.loads(line)["actor"]["account"]["name"] for line in lines] == ["anonymous", "anonymous"]
    assert "team" not in json.loads(lines[0])["context"]


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0, "PT0S"), (2.5, "PT2.5S"), (59.999, "PT1M0S"), (62.5, "PT1M2.5S"), (600, "PT10M0S"), (3.14159, "PT3.14S")],
)
def test_durations_are_iso_8601_in_hundredths_of_a_second(seconds, words):
    assert duration(seconds) == words

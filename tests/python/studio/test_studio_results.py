"""All results of a person as one file."""

import json

import pytest
from punctura.exercise import ResultStore
from punctura.exercise.result import Metrics, Result


def result(person):
    metrics = dict.fromkeys(Metrics.model_fields) | {
        "entries": 1, "peak_force": 0.9, "peak_felt_force": 0.9, "force_scale": 1.0, "losses": [], "yields": [],
        "overshoot": [], "dwell": 0.0, "longest_stay": 0.0, "total_time": 2.0, "lost_ticks": 0, "force_cut": {},
        "page_late": 0.0, "force_off": 0.0,
    }  # fmt: skip
    return Result(
        exercise="venipuncture", title="Venipuncture", scene="Venipuncture", person=person,
        date="2026-01-02T03:04:05Z", version="0", passed=False, reasons=["You did not reach the vein."], goals=[],
        metrics=Metrics(**metrics), events=[],
    )  # fmt: skip


@pytest.fixture
def kept(served):
    store: ResultStore = served.session.results
    return [store.save(result(person)).name for person in ("Ada", "Ada", "Bob")]


def test_the_results_of_a_person_come_as_one_file(page, kept):
    status, text = page.get("/api/results/download?person=Ada&format=csv")
    assert status == 200 and text.decode().count("Ada") == 2 and b"Bob" not in text
    assert len(json.loads(page.get("/api/results/download?person=Ada")[1])) == 2
    assert len(json.loads(page.get("/api/results/download?format=json")[1])) == 3
    statements = page.get("/api/results/download?person=Bob&format=xapi")[1].splitlines()
    assert [json.loads(line)["actor"]["name"] for line in statements] == ["Bob"]
    assert page.get("/api/results/download?format=xls")[0] == 400


def test_the_results_of_a_class_come_together(page, served, kept):
    served.session.results.save(result("Cem").model_copy(update={"group": "9b"}))
    served.session.results.save(result("Dan").model_copy(update={"group": "9b"}))
    assert {one["person"] for one in page.json("/api/results?group=9b")} == {"Cem", "Dan"}
    assert [one["person"] for one in page.json("/api/results?group=9b&person=Dan")] == ["Dan"]
    assert len(page.json("/api/results")) == 5

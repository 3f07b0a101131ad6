"""What the studio tells of a running attempt, what it refuses, what it keeps; results as a file; the expert's run."""

import json

import pytest
from attempts import as_a_device_runs_it, hand_run
from punctura import load_scene
from punctura._core import SimulatedDevice
from punctura.exercise import ResultStore, load_exercise
from punctura.exercise.result import Metrics, Result
from punctura.simulation import RecordedMotion
from punctura.studio.activity import ExerciseActivity
from punctura.studio.catalog import DraftResults
from punctura.studio.experts import Experts
from recorded import recorded
from runs import cut

from .test_studio_making import TABLES, names

BLIND_LEGS = (0.3, 0.0), (8.0, 17.5), (4.0, 17.5)


def told(name, legs, results):
    """The messages of an attempt by a simulated hand, and how it ended."""
    exercise = load_exercise(name)
    activity = ExerciseActivity(exercise, "Ada", "", results)
    activity.begin(as_a_device_runs_it(exercise.scene))
    columns = hand_run(name, legs)
    messages = []
    for batch in cut(columns, range(0, len(columns["depth"]), 270)):
        messages += activity.ticks(batch, 0.0)
    return messages, activity.finish()


def test_a_blind_exercise_tells_nothing_of_the_needle_before_it_is_decided(tmp_path):
    exercise = load_exercise("blind")
    messages, outcome = told("blind", BLIND_LEGS, ResultStore(tmp_path))
    blindfolded, decided = messages[:-1], messages[-1]
    assert len(blindfolded) > 20 and all(message.blind for message in blindfolded)
    for message in blindfolded:
        assert message.instruction == exercise.instruction
        assert {goal.state for goal in message.goals} == {"open"}
        assert (message.held, message.hold) == (0.0, 0.0)
    assert {goal.state for goal in decided.goals} == {"met"} and decided.instruction != exercise.instruction
    assert outcome.message.result


def test_the_result_of_a_draft_is_told_if_the_next_run_has_begun():
    _, outcome = told("blind", BLIND_LEGS, DraftResults())
    assert (outcome.message.result, outcome.notice) == ("draft", "Blind: passed.")


def test_the_last_result_of_a_draft_is_shown_but_not_kept_and_it_has_no_experts_run(page, served):
    assert page.ask(do="try_exercise", tables=TABLES, person="Ada")["ok"]
    page.wait(lambda: page.of("exercise")[-1]["running"])
    page.target([0.0, -2e-3, 0.0], [0.0, -1.0, 0.0])
    page.wait(lambda: any(event["what"] == "touch" for event in page.of("event")))
    assert page.ask(do="end_exercise")["ok"]
    page.wait(lambda: page.of("exercise")[-1]["result"] == "draft")
    result = page.json("/api/results/draft")
    assert (result["name"], result["exercise"], result["person"]) == ("draft", "draft", "Ada")
    assert result["coaching"]["change"] and result["recording"]
    assert page.json("/api/results") == []
    refused = page.ask(do="set_expert", exercise="draft", recording="")
    assert not refused["ok"] and "save the exercise first" in refused["text"]


def test_a_draft_that_cannot_start_is_not_listed(page, served, monkeypatch):
    def fail(*_):
        raise OSError("no space")

    monkeypatch.setattr(served.session, "begin_activity", fail)
    assert not page.ask(do="try_exercise", tables=TABLES)["ok"]
    assert "draft" not in names(page)


def test_the_hand_does_not_move_by_itself_while_an_exercise_runs(page, served):
    motion = RecordedMotion([0.0, 1.0], [[0.0, 5e-3, 0.0], [0.0, 5e-3, 0.0]])
    device = SimulatedDevice(motion, real_time=False, ticks=500)
    recorded(served.session.shelf.file("hers"), device, as_a_device_runs_it(load_scene("venipuncture")), 500)
    assert page.ask(do="start_exercise", exercise="venipuncture")["ok"]
    for request in ({"do": "strokes", "period": 2.0}, {"do": "play_motion", "recording": "hers"}):
        refused = page.ask(**request)
        assert (refused["ok"], refused["text"]) == (False, "the exercise judges your own hand; end it first")
    assert page.ask(do="end_exercise")["ok"]
    assert page.ask(do="strokes", period=2.0)["ok"]


def result(person):
    metrics = dict.fromkeys(Metrics.model_fields) | {
        "entries": 1, "peak_force": 0.9, "peak_felt_force": 0.9, "force_scale": 1.0, "losses": [], "yields": [],
        "overshoot": [], "dwell": 0.0, "longest_stay": 0.0, "total_time": 2.0, "lost_ticks": 0, "force_cut": {},
        "page_late": 0.0, "computer_late": 0.0, "force_off": 0.0,
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


def expert_of(page, name="venipuncture"):
    return next(entry["expert"] for entry in page.json("/api/exercises") if entry["name"] == name)


def test_a_recording_is_named_kept_and_taken_back(page, served):
    folder = served.session.shelf.folder
    for name, scene in (("hers", "venipuncture"), ("other", "k06-fig12")):
        at_rest = as_a_device_runs_it(load_scene(scene))
        motion = RecordedMotion([0.0, 1.0], [[0.0, 5e-3, 0.0], [0.0, 5e-3, 0.0]])
        device = SimulatedDevice(motion, real_time=False, ticks=500)
        recorded(served.session.shelf.file(name), device, at_rest, 500)
    assert expert_of(page) == ""
    assert page.ask(do="set_expert", exercise="venipuncture", recording="hers")["ok"]
    assert expert_of(page) == "hers" and expert_of(page, "epidural") == ""
    assert Experts(served.session.results.folder).all() == {"venipuncture": "hers"}  # after a restart, too
    refused = page.ask(do="set_expert", exercise="venipuncture", recording="other")
    assert not refused["ok"] and "has no membrane" in refused["problems"][0]["reason"]
    for recording in ("none", "../results/x"):
        assert not page.ask(do="set_expert", exercise="venipuncture", recording=recording)["ok"]
    assert not page.ask(do="set_expert", exercise="nothing", recording="hers")["ok"]
    assert expert_of(page) == "hers"
    (folder / "hers.parquet").unlink()
    assert expert_of(page) == ""
    assert page.ask(do="set_expert", exercise="venipuncture", recording="")["ok"]
    assert Experts(served.session.results.folder).all() == {}


@pytest.mark.parametrize("text", ["[1", "[]", '{"blind": 3}', "\udcff"])
def test_a_damaged_file_is_kept_under_another_name_and_told(tmp_path, text):
    data, path = text.encode("utf-8", "surrogateescape"), tmp_path / "results-experts.json"
    told = []
    experts = Experts(tmp_path / "results", told.append)
    for k in (1, 2):
        path.write_bytes(data)
        assert experts.all() == {} and len(told) == k
        assert f"results-experts-damaged-{k}.json" in told[-1]
        experts.set("blind", "a run")
        assert experts.all() == Experts(tmp_path / "results").all() == {"blind": "a run"}
        assert (tmp_path / f"results-experts-damaged-{k}.json").read_bytes() == data
    assert len(told) == 2


def test_the_page_is_told_that_the_file_was_damaged(page, served):
    folder = served.session.results.folder
    folder.mkdir(parents=True, exist_ok=True)
    (folder.parent / f"{folder.name}-experts.json").write_text("{", encoding="utf-8")
    assert expert_of(page) == ""
    page.wait(lambda: any("is damaged" in notice["text"] for notice in page.of("notice")))

"""What the studio tells of a running attempt, what it refuses during one, and what it keeps of it."""

from attempts import as_a_device_runs_it, hand_run
from punctura import load_scene
from punctura._core import SimulatedDevice
from punctura.exercise import ResultStore, load_exercise
from punctura.simulation import RecordedMotion
from punctura.studio.activity import ExerciseActivity
from recorded import recorded
from runs import cut

from .test_studio_making import TABLES, names

BLIND_LEGS = (0.3, 0.0), (8.0, 17.5), (4.0, 17.5)


def told(name, legs, results=None):
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


def test_the_result_of_a_draft_is_told_but_not_kept():
    _, outcome = told("blind", BLIND_LEGS)
    assert outcome.message.result == ""
    assert outcome.remark.startswith("Blind: passed. ") and outcome.remark.endswith("is not kept.")


def test_a_draft_has_no_result_and_no_experts_run(page, served):
    assert page.ask(do="try_exercise", tables=TABLES, person="Ada")["ok"]
    page.wait(lambda: page.of("exercise")[-1]["running"])
    page.target([0.0, -2e-3, 0.0], [0.0, -1.0, 0.0])
    page.wait(lambda: any(event["what"] == "touch" for event in page.of("event")))
    assert page.ask(do="end_exercise")["ok"]
    page.wait(lambda: any("is not kept" in notice["text"] for notice in page.of("notice")))
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

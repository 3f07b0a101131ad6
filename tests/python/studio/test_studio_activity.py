"""A session runs any kind of activity: an exercise, or a class of a few lines."""

import errno
import threading

import pytest
from punctura import PuncturaError
from punctura.exercise import ResultStore
from punctura.studio.activity import Outcome
from punctura.studio.loaded import from_name
from punctura.studio.wire.messages import Notice


class CountTicks:
    """Ends the run after the given number of ticks."""

    what = "count"

    def __init__(self, most: int) -> None:
        self.most, self.count, self.end_at, self.calls = most, 0, None, []

    def begin(self, scene):
        self.calls.append(("begin", scene.name))

    def ticks(self, columns, now):
        self.count += len(columns["tick"])
        if self.count >= self.most and self.end_at is None:
            self.end_at = now
            return [Notice(text="enough ticks")]
        return []

    def scene_change(self):
        raise PuncturaError("the count needs one scene")

    def stop(self):
        self.calls.append(("stop", threading.current_thread().name))

    def finish(self):
        self.calls.append(("finish", threading.current_thread().name))
        return Outcome(Notice(text=f"counted to the end: {self.count}"), "the count before is over")


def texts(page):
    return [message["text"] for message in page.of("notice")]


def begin(served, activity, record=None):
    loaded = from_name("k06-fig10")
    served.session.call(lambda: served.session.begin_activity(activity, loaded, record=record)).result(30)


@pytest.mark.parametrize("record", [None, "counted"])
def test_a_session_runs_an_activity_that_it_does_not_know(served, page, record):
    count, run = CountTicks(200), served.session.run.number
    begin(served, count, record)
    page.wait(lambda: f"counted to the end: {count.count}" in texts(page))
    assert count.count >= 200 and "enough ticks" in texts(page)
    assert [call for call, _ in count.calls] == ["begin", "stop", "finish"]
    assert count.calls[0] == ("begin", from_name("k06-fig10").scene.name)
    assert count.calls[1][1] == "punctura-studio"
    assert (count.calls[2][1] == "punctura-studio") == (record is None)  # a recording is finished in its own thread
    page.wait(lambda: served.session.run.number == run + 2 and served.session.run.loop.running)
    assert served.session.activities.now is None


def test_an_activity_may_refuse_another_scene_and_owns_its_recording(served, page):
    begin(served, CountTicks(10**9), "counted")
    page.wait(lambda: page.of("scene")[-1]["scene"]["name"] == from_name("k06-fig10").scene.name)
    refused = page.ask(do="edit", tables=from_name("k06-fig11").tables())
    assert (refused["ok"], refused["text"]) == (False, "the count needs one scene")
    assert page.of("scene")[-1]["scene"]["name"] == from_name("k06-fig10").scene.name
    refused = page.ask(do="stop_recording")
    assert (refused["ok"], refused["text"]) == (False, "the count is recorded until it ends")


def test_the_outcome_of_an_activity_becomes_a_notice_when_another_one_runs(served, page):
    for most in (10**9, 10**9 + 1):
        begin(served, CountTicks(most))
    page.wait(lambda: texts(page))
    assert page.wait(lambda: "the count before is over" in texts(page) or None)
    assert not any(text.startswith("counted to the end") for text in texts(page))


def test_a_result_that_cannot_be_saved_is_told_and_the_exercise_ends(served, page, monkeypatch):
    def full(store, result):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(ResultStore, "save", full)
    assert page.ask(do="start_exercise", exercise="venipuncture")["ok"]
    for k in range(1, 41):
        page.target([0.0, 5e-3 - 4e-4 * k, 0.0], [0.0, -1.0, 0.0])
        page.wait(lambda n=page.ticks: page.ticks > n + 20)
    page.wait(lambda: page.of("exercise")[-1]["running"])
    assert page.ask(do="end_exercise")["ok"]
    page.wait(lambda: any("cannot be saved" in text and "No space left" in text for text in texts(page)))
    assert not page.of("exercise")[-1]["running"]

"""Only a person turns the force on again, after it was turned off or after a fault."""

import pytest
from punctura._core import DeviceError, ServoState
from punctura.studio.run import Run

from .test_studio_busy import busy

UNARMED = int(ServoState.disarmed)
NEW_RUNS = [
    {"do": "load", "scene": "k06-fig10"},
    {"do": "load_text", "toml": None},
    {"do": "start_recording", "name": "after"},
    {"do": "start_exercise", "exercise": "venipuncture"},
]


def begin(served, page, request):
    """Begins another run, and returns after its first ticks."""
    if "toml" in request:
        request = {**request, "toml": served.session.run.loaded.text()}
    before = page.run
    assert page.ask(**request)["ok"]
    page.wait(lambda: page.run > before and page.last.run == page.run and page.last.first_tick > 10)


def turned_off(served, page):
    assert page.ask(do="pause")["ok"]


def fault(served, page):
    assert page.ask(do="trip_fault")["ok"]
    page.wait(lambda: any(told["reason"] for told in page.of("fault")))


def fault_and_reset(served, page):
    fault(served, page)
    assert page.ask(do="reset")["ok"]


def fault_that_no_frame_has_shown(served, page):
    served.session.call(lambda: served.session.bench.simulated_device.trip()).result(60)
    loop = served.session.run.loop
    page.wait(lambda: int(loop.latest()["fault"][0]) != 0)


@pytest.mark.parametrize("request_", NEW_RUNS, ids=lambda request: request["do"])
@pytest.mark.parametrize("off", [turned_off, fault, fault_and_reset, fault_that_no_frame_has_shown])
def test_no_new_run_gives_force_until_a_person_turns_it_on(served, page, off, request_):
    page.wait(lambda: page.last.ticks["state"][-1] != UNARMED)
    off(served, page)
    begin(served, page, request_)
    assert page.last.ticks["state"][-1] == UNARMED and not page.status()["armed"]
    assert any("force is still off" in notice["text"] for notice in page.of("notice"))
    assert page.ask(do="arm")["ok"]
    page.wait(lambda: page.last.ticks["state"][-1] != UNARMED)
    begin(served, page, {"do": "load", "scene": "k06-fig12"} if "exercise" not in request_ else {"do": "end_exercise"})
    page.wait(lambda: page.last.ticks["state"][-1] != UNARMED)
    assert page.status()["armed"]


def test_no_run_that_begins_by_itself_reminds_of_the_force_that_is_off(served, page):
    turned_off(served, page)
    served.session.call(served.session.run.stop).result(60)
    before = page.run
    assert page.ask(do="reset")["ok"]
    page.wait(lambda: page.run > before and page.last.run == page.run)
    assert not any("force is still off" in notice["text"] for notice in page.of("notice"))


def test_what_waits_for_the_worker_while_the_ticks_cease_does_not_arm(served, page, monkeypatch):
    page.wait(lambda: page.last.ticks["state"][-1] != UNARMED)
    session, before = served.session, page.run
    with busy(session):
        page.send('{"id": 1001, "do": "load", "scene": "k06-fig10"}')
        silent = session.run
        monkeypatch.setattr(Run, "silence", property(lambda run: "the ticks have ceased" if run is silent else ""))
    page.wait(lambda: page.run > before and page.last.run == page.run and page.last.first_tick > 10)
    assert page.last.ticks["state"][-1] == UNARMED and not page.status()["armed"]


@pytest.mark.parametrize("recorded", [False, True])
def test_after_a_device_that_did_not_start_no_run_gives_force_by_itself(served, page, monkeypatch, recorded):
    page.wait(lambda: page.last.ticks["state"][-1] != UNARMED)

    def refused(*_, **__):
        raise DeviceError("the cable is out")

    request = {"do": "start_recording", "name": "x"} if recorded else {"do": "load", "scene": "k06-fig10"}
    with monkeypatch.context() as patched:
        patched.setattr(Run, "start", refused)
        patched.setattr("punctura.studio.run.Recorder", refused)  # no run with a recording, and none without
        assert "the cable is out" in page.ask(**request)["text"]
    begin(served, page, {"do": "load", "scene": "k06-fig10"})
    assert page.last.ticks["state"][-1] == UNARMED and not page.status()["armed"]

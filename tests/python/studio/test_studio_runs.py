"""Data of runs for a page: the run to which a target belongs, and the hand's position when a page connects."""

import numpy as np
import pytest
from punctura.exercise import load_exercise
from punctura.live import RunLimits, SecondDevice
from punctura.studio.client import StudioClient
from punctura.studio.run import Settings

from .conftest import serve

DOWN = [0.0, -1.0, 0.0]
SLANTED = [np.sin(np.pi / 3), -np.cos(np.pi / 3), 0.0]


def at(served):
    pose = served.session.hand.pose
    return None if pose is None else [list(part) for part in pose]


@pytest.mark.parametrize(
    "begin", [{"do": "load", "scene": "k06-fig10"}, {"do": "start_exercise", "exercise": "venipuncture"}]
)
def test_a_target_of_the_run_before_moves_nothing_in_the_next(served, page, begin):
    deep = [0.0, -20e-3, 0.0]
    page.target(deep, DOWN)
    page.wait(lambda: at(served)[0] == deep)
    before = page.run
    assert page.ask(**begin)["ok"]
    page.wait(lambda: page.run > before)
    rests = at(served)
    page.target(deep, DOWN, run=before)  # a drag that was held; a page that is late
    page.target(deep, DOWN, run=before + 7)
    assert page.ask(do="compare", on=False)["ok"]  # the worker has seen both
    assert at(served) == rests
    if begin["do"] == "start_exercise":
        assert rests == [
            list(load_exercise("venipuncture").start_position),
            list(load_exercise("venipuncture").start_axis),
        ]
    page.target([0.0, 4e-3, 0.0], DOWN)
    page.wait(lambda: at(served)[0] == [0.0, 4e-3, 0.0])


def test_a_page_is_told_of_a_force_above_the_devices_rating(tmp_path):
    server = serve(tmp_path, settings=Settings(limits=RunLimits().at_most(5.0)))
    try:
        with StudioClient(server.address.url) as page:
            [status] = page.wait(lambda: page.of("status")[:1])
            assert any("max_force_N = 5 is above the rating" in note for note in status["statements"])
    finally:
        server.stop()


def test_a_scene_without_a_syringe_tells_the_pages_that_the_second_device_gives_no_force(tmp_path):
    server = serve(tmp_path, "epidural", Settings(second=SecondDevice("simulated")))
    try:
        with StudioClient(server.address.url) as page:
            [status] = page.wait(lambda: page.of("status")[:1])
            assert status["second"]["rate"] == 1600 and status["second"]["max_force"] == pytest.approx(3.3)
            assert "this scene has no syringe" not in " ".join(status["statements"])
            assert page.ask(do="load", scene="venipuncture")["ok"]
            page.wait(lambda: any("This scene has no syringe" in notice["text"] for notice in page.of("notice")))
            page.wait(lambda: "this scene has no syringe" in " ".join(page.of("status")[-1]["statements"]))
    finally:
        server.stop()


def test_frames_and_scene_messages_have_the_same_number(page):
    for number in (1, 2):
        assert page.ask(do="load", scene="k06-fig10")["ok"]
        page.wait(lambda n=number: page.run == n and page.last.run == n)


def test_who_gets_control_is_told_where_the_hand_is(served, page):
    place = [1e-3, 5e-3, 0.0]
    page.target(place, SLANTED)
    page.wait(lambda: at(served)[0] == place)
    with StudioClient(served.address.url) as looks_on:
        looks_on.wait(lambda: looks_on.of("control"))
        assert looks_on.of("control")[-1]["hand"] is None
        page.close()  # and is loaded anew
        looks_on.wait(lambda: looks_on.of("control")[-1]["holder"] is None)
        with StudioClient(served.address.url) as again:
            told = again.wait(lambda: next((c for c in again.of("control") if c["you"]), None))
            assert told["hand"]["position"] == place
            assert told["hand"]["axis"] == pytest.approx(SLANTED)
            assert again.ask(do="strokes", period=2.0)["ok"]
        looks_on.wait(lambda: looks_on.of("control")[-1]["holder"] is None)
        assert looks_on.ask(do="take_control")["ok"]
        assert looks_on.of("control")[-1] == {
            "kind": "control",
            "holder": looks_on.of("hello")[0]["viewer"],
            "you": True,
            "hand": None,
        }

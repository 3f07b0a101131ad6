"""Requests of a page to a running studio, over a real socket."""

import numpy as np
import punctura as pn
import pytest
from punctura._core import ServoState
from punctura.exercise import exercise_names, load_exercise
from punctura.live import RunLimits
from punctura.studio.client import StudioClient
from punctura.studio.run import Settings

from .conftest import serve

AXIS = [0.0, -1.0, 0.0]


def all_rows(page, column):
    return np.concatenate([f.ticks[column] for f in page.frames if f.run == page.frames[-1].run])


def test_a_newcomer_is_told_everything_there_is(page):
    page.wait(lambda: page.of("status"))
    kinds = [m["kind"] for m in page.messages]
    assert kinds[0] == "hello"
    hello, scene = page.of("hello")[0], page.of("scene")[0]
    assert hello["device"]["simulated"] and {"name": "venipuncture", "title": "Venipuncture"} in hello["scenes"]
    assert [c["name"] for c in hello["exercises"]] == exercise_names()
    assert scene["new_run"] and [m["name"] for m in scene["scene"]["membranes"]] == [
        "first membrane",
        "second membrane",
    ]
    assert {"control", "fault", "exercise"} <= set(kinds)


def test_the_limits_that_were_chosen_are_told_and_hold(tmp_path):
    server = serve(tmp_path, settings=Settings(limits=RunLimits().at_most(0.4)))
    try:
        with StudioClient(server.address.url, keep_frames=True) as page:
            page.wait(lambda: page.of("hello"))
            hello = page.of("hello")[0]
            assert hello["device"]["max_force"] == hello["limits"]["max_force"] == 0.4
            loop = server.session.run.loop
            of_loop = {name: getattr(loop.limits, name, getattr(loop.gate, name, [])) for name in hello["limits"]}
            assert hello["limits"] == of_loop and of_loop["continuous_force"] > 0
            assert page.ask(do="strokes", period=1.0)["ok"]
            page.wait(lambda: sum(e["what"] == "out" for e in page.of("event")) >= 2)
            strongest = np.linalg.norm(all_rows(page, "force"), axis=1).max()
            assert strongest == pytest.approx(0.4, rel=1e-6)
    finally:
        server.stop()


def test_every_tick_comes_once_and_in_order(page):
    page.wait(lambda: page.ticks > 1600)
    tick = np.concatenate([f.first_tick + np.arange(len(f)) for f in page.frames])
    assert np.array_equal(tick, tick[0] + np.arange(len(tick)))
    assert page.frames[-1].lost == 0
    time = np.concatenate([f.first_time + f.ticks["time"].astype(float) for f in page.frames])
    assert np.all(np.diff(time) > 0)


def test_a_page_that_says_what_it_took_gets_the_next_ticks_after_that_and_misses_none(served, page):
    (viewer,) = served.hub.viewers.values()
    took = '{"do": "took"}'
    page.send(took)
    page.wait(lambda: viewer.waiting > 30)
    before = page.ticks
    for _ in page.frames:
        page.send(took)
    page.wait(lambda: page.ticks > before)
    assert page.gaps == 0


def test_the_hand_is_dragged_through_a_membrane_and_the_pop_is_told_and_seen(page):
    page.wait(lambda: page.last.ticks["state"][-1] == int(ServoState.active))
    for k in range(100):
        page.target([0.0, 5e-3 - 2e-4 * k, 0.0], AXIS)
        page.wait(lambda n=page.ticks: page.ticks > n + 30)
    pop = page.wait(lambda: next((e for e in page.of("event") if e["what"] == "pop"), None))
    assert pop["name"] == "first membrane"
    law = pn.ThickLaw(pn.load_scene("k06-fig12").needle, pn.load_scene("k06-fig12").membranes[0].membrane)
    strongest = -float(np.min(law.bounds(np.linspace(0, law.X + law.U, 10001))[0]))
    assert pop["force_before"] == pytest.approx(strongest, rel=0.02)
    assert pop["drop"] == pytest.approx(strongest - law.F, rel=0.02)
    assert float(np.abs(all_rows(page, "force")).max()) > 0.5


def test_strokes_go_through_all_membranes_until_the_next_target(page):
    assert page.ask(do="strokes", period=1.0)["ok"]
    page.wait(lambda: sum(e["what"] == "out" for e in page.of("event")) >= 2)
    page.wait(lambda: page.status()["hand"] == "strokes")
    page.target([0.0, 5e-3, 0.0], AXIS)
    page.wait(lambda: page.status()["hand"] == "target")


def test_an_edit_takes_effect_between_two_ticks_and_a_bad_one_changes_nothing(page):
    tables = page.of("scene")[-1]["scene"]["tables"]
    laws = page.of("scene")[-1]["scene"]["laws"]
    tables["membrane"][0]["friction"] = 3.9
    tables["needle"]["colour"] = "blue"
    bad = page.ask(do="edit", tables=tables)
    assert not bad["ok"]
    assert {p["path"] for p in bad["problems"]} == {"needle.colour", "membrane[0].friction"}
    assert len(page.of("scene")) == 1

    del tables["needle"]["colour"]
    tables["membrane"][0]["friction"] = 0.3
    assert page.ask(do="edit", tables=tables)["ok"]
    edited = page.of("scene")[-1]
    assert not edited["new_run"] and edited["scene"]["number"] == 1
    assert edited["scene"]["tables"]["membrane"][0]["friction"] == 0.3
    assert min(edited["scene"]["laws"][0]["lower"]) < min(laws[0]["lower"])
    assert page.gaps == 0 and page.last.run == 0


def test_an_edit_may_add_and_take_away_membranes(page):
    tables = page.of("scene")[-1]["scene"]["tables"]
    more = {
        **tables,
        "membrane": [*tables["membrane"], {**tables["membrane"][0], "name": "third", "point_mm": [0, -20, 0]}],
    }
    for given, count in ((more, 3), (tables, 2), ({**tables, "membrane": tables["membrane"][:1]}, 1)):
        assert page.ask(do="edit", tables=given)["ok"]
        page.wait(lambda c=count: page.last.membranes == c)
    assert page.gaps == 0


def test_pause_and_arm_say_what_they_say(page):
    page.wait(lambda: page.last.ticks["state"][-1] == int(ServoState.active))
    assert page.ask(do="pause")["ok"]
    page.wait(lambda: page.last.ticks["state"][-1] == int(ServoState.disarmed))
    assert page.ask(do="arm")["ok"]
    page.wait(lambda: page.last.ticks["state"][-1] == int(ServoState.active))
    page.wait(lambda: page.status()["armed"])


def test_a_fault_is_told_with_its_reason_and_left_by_a_reset(page):
    assert page.ask(do="trip_fault")["ok"]
    fault = page.wait(lambda: next((f for f in page.of("fault") if f["reason"]), None))
    assert fault["fault"] == "non_finite_input" and fault["kept"] > 0 and fault["tick"] is not None
    assert "not finite" in fault["reason"] and "cable" in fault["remedy"]
    page.wait(lambda: page.last.ticks["state"][-1] == int(ServoState.faulted))
    assert not page.last.ticks["force"][-1].any()
    assert page.ask(do="reset")["ok"]
    page.wait(lambda: page.of("fault")[-1]["reason"] == "")
    assert page.ask(do="arm")["ok"]
    page.wait(lambda: page.last.ticks["state"][-1] == int(ServoState.active))


def test_the_other_solver_runs_beside_and_begins_equal(page):
    assert page.ask(do="compare", on=True)["ok"]
    assert page.ask(do="strokes", period=1.0)["ok"]
    page.wait(lambda: sum(e["what"] == "pop" for e in page.of("event")) >= 2)
    both = [f for f in page.frames if "other_force" in f.ticks]
    other = np.concatenate([f.ticks["other_force"] for f in both])
    own = np.concatenate([f.ticks["model_force"] for f in both])
    assert np.isfinite(other).all()
    assert np.array_equal(other[:10], own[:10])
    assert 1e-3 < np.abs(other - own).max() < 1.0
    assert page.ask(do="compare", on=False)["ok"]
    page.wait(lambda: "other_force" not in page.last.ticks)


def test_the_live_estimate_finds_the_pop_that_the_law_tells(page):
    assert page.ask(do="estimate", on=True)["ok"]
    assert page.ask(do="strokes", period=2.0)["ok"]
    found = page.wait(lambda: [f for e in page.of("estimate") for f in e["found"]])
    pop = page.wait(lambda: next((e for e in page.of("event") if e["what"] == "pop"), None))
    assert abs(found[0]["tick"] - pop["tick"]) < 160  # 0.1 s
    told = page.wait(lambda: next((e for e in page.of("estimate") if e["plateau"]), None))
    assert told["on"] and told["phase"] == "behind" and told["punctures"] >= 1
    assert told["plateau"]["half"] > 0
    assert page.ask(do="estimate", on=False)["ok"]
    page.wait(lambda: page.of("estimate")[-1]["on"] is False)


def test_a_scene_is_loaded_by_name_and_by_text_as_a_new_run(page):
    assert page.ask(do="load", scene="venipuncture")["ok"]
    scene = page.of("scene")[-1]
    assert scene["new_run"] and scene["scene"]["name"] == "Venipuncture" and scene["scene"]["lumen"] == [1, 2]
    page.wait(lambda: page.last.run == 1 and page.last.membranes == 3)
    assert next(f for f in page.frames if f.run == 1).first_tick == 0

    text = page.get("/api/scene.toml")[1].decode()
    assert "gauge = 21" in text and 'behind = "blood"' in text
    assert page.ask(do="load_text", toml=text.replace("Venipuncture", "Mine"))["ok"]
    assert page.of("scene")[-1]["scene"]["name"] == "Mine"
    bad = page.ask(do="load_text", toml="name = ")
    assert not bad["ok"] and "not TOML" in bad["problems"][0]["reason"]
    exercise = page.ask(do="load_text", toml=load_exercise("epidural").path.read_text(encoding="utf-8"))
    assert not exercise["ok"] and "this is an exercise, not a scene" in exercise["problems"][0]["reason"]
    assert not page.ask(do="load", scene="../../etc/passwd")["ok"]
    assert page.of("scene")[-1]["scene"]["name"] == "Mine"


def test_the_laws_follow_the_needle_when_it_turns(page):
    page.target([0.0, 5e-3, 0.0], [1.0, -1.0, 0.0])
    laws = page.wait(lambda: next((m["laws"] for m in page.of("laws") if m["laws"][0]["obliquity"] > 0.7), None))
    assert laws[0]["obliquity"] == pytest.approx(np.pi / 4, abs=0.01)
    assert laws[0]["far_face"] == pytest.approx(1e-3 * np.sqrt(2), rel=0.02)
    assert laws[0]["through"] == pytest.approx(page.of("scene")[-1]["scene"]["tip_length"] + laws[0]["far_face"])


@pytest.mark.parametrize("axis", [[0, 0, 0], [1e300, 0, 0]])
def test_a_target_that_is_none_is_told_and_moves_nothing(page, axis):
    page.target([0.0, 0.0, 0.0], [float(a) for a in axis])
    page.wait(lambda: any("axis" in n["text"] for n in page.of("notice")))
    page.target([9.0, 0.0, 0.0], AXIS)
    page.wait(lambda: len(page.of("notice")) == 2)
    told = len(page.frames)
    page.wait(lambda: len(page.frames) > told + 10)
    tip = all_rows(page, "tip")
    assert np.abs(tip - tip[0]).max() < 1e-3


def test_who_has_no_control_may_turn_the_force_off_or_take_control_and_nothing_else(served, page):
    with StudioClient(served.address.url) as other:
        other.wait(lambda: other.of("control"))
        assert not other.of("control")[-1]["you"]
        assert other.ask(do="pause")["ok"] and not page.status()["armed"]
        refused = other.ask(do="arm")
        assert not refused["ok"] and "control" in refused["text"]
        other.target([0.0, -10e-3, 0.0], AXIS)
        other.wait(lambda n=other.ticks: other.ticks > n + 200)  # the hand would have moved
        assert page.last.ticks["tip"][-1][1] > 4e-3
        assert other.ask(do="take_control")["ok"]
        page.wait(lambda: not page.of("control")[-1]["you"])
        assert not page.ask(do="arm")["ok"]
        assert other.ask(do="arm")["ok"]
    page.wait(lambda: page.of("control")[-1]["holder"] is None)
    with StudioClient(served.address.url) as third:
        third.wait(lambda: third.of("control") and third.of("control")[-1]["you"])

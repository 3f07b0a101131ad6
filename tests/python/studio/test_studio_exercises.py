"""User exercises in the studio: only files from the command line, never a file named by a page."""

import numpy as np
import pytest
from attempts import HEAD, goal
from punctura import ConfigurationError, save_scene
from punctura.exercise import Attempt, exercise_names, load_exercise
from punctura.live import SecondDevice
from punctura.studio import activity as activities
from punctura.studio.catalog import Exercises
from punctura.studio.client import StudioClient
from punctura.studio.run import Settings

from .conftest import serve

GOALS = goal("reach", text="Into the vein"), goal("time_limit", seconds=60)


def own_file(folder, text=None, name="mine"):
    path = folder / f"{name}.toml"
    path.write_text(text or HEAD + "".join(GOALS), encoding="utf-8")
    return path


@pytest.fixture
def own(tmp_path):
    """An exercise with its own scene file in the same folder."""
    save_scene(load_exercise("venipuncture").scene.replace(name="Somebody"), tmp_path / "somebody.toml")
    return own_file(tmp_path, HEAD.replace('scene = "venipuncture"', 'scene = "somebody.toml"') + "".join(GOALS))


@pytest.fixture
def page(tmp_path, own):
    server = serve(tmp_path, exercises=Exercises([own]))
    with StudioClient(server.address.url) as client:
        client.wait(lambda: client.of("scene") and client.last)
        yield client
    server.stop()


def test_an_exercise_of_ones_own_runs_and_gives_a_result(page):
    assert page.of("hello")[0]["exercises"][0] == {"name": "mine", "title": "Test"}
    listed = page.json("/api/exercises")
    assert [entry["name"] for entry in listed] == ["mine", *exercise_names()]
    assert listed[0]["scene"] == "Somebody" and listed[0]["problems"] == []
    assert page.ask(do="start_exercise", exercise="mine", person="Ada")["ok"]
    page.wait(lambda: page.of("exercise")[-1]["running"])
    assert page.of("exercise")[-1]["time_limit"] == 60
    assert page.of("scene")[-1]["scene"]["name"] == "Somebody"
    for k in range(1, 41):
        page.target([0.0, 5e-3 - 4e-4 * k, 0.0], [0.0, -1.0, 0.0])
        page.wait(lambda n=page.ticks: page.ticks > n + 40)
    name = page.wait(lambda: page.of("exercise")[-1]["result"] or None, 30)
    result = page.json(f"/api/results/{name}")
    assert (result["exercise"], result["title"], result["passed"]) == ("mine", "Test", True)
    trace = page.json(f"/api/recordings/{result['recording']}/trace")
    assert max(f for f in trace["force"] if f is not None) >= result["metrics"]["peak_force"] - 1e-5


def test_a_file_is_read_anew_and_what_is_wrong_with_it_is_shown_with_path_value_bound_and_reason(page, own):
    sound = own.read_text(encoding="utf-8")
    own.write_text(sound.replace("seconds = 60", "seconds = -60"), encoding="utf-8")
    wrong = {"path": "goal[1].seconds", "value": "-60", "reason": "must be at least 0.01 s"}
    assert page.json("/api/exercises")[0]["problems"] == [wrong]
    refused = page.ask(do="start_exercise", exercise="mine")
    assert not refused["ok"] and refused["problems"] == [wrong]
    own.unlink()
    assert "no such file" in page.json("/api/exercises")[0]["problems"][0]["reason"]
    own.write_text(sound.replace('"Test"', '"Mended"'), encoding="utf-8")
    assert page.json("/api/exercises")[0]["title"] == "Mended"
    assert page.ask(do="start_exercise", exercise="mine")["ok"]


@pytest.mark.parametrize("name", ["mine.toml", "./mine", "../mine.toml", "other", "/etc/hostname"])
def test_a_page_cannot_name_a_file(page, own, tmp_path, name):
    own_file(tmp_path, name="other")
    answer = page.ask(do="start_exercise", exercise=name)
    assert not answer["ok"] and "there is no exercise" in answer["text"]


def test_a_path_from_the_page_is_too_long_for_a_name_or_is_none(page, own):
    answer = page.ask(do="start_exercise", exercise=str(own)[:80])
    assert not answer["ok"] and "there is no exercise" in answer["text"]


def test_names_must_tell_exercises_apart(tmp_path):
    (tmp_path / "b").mkdir()
    for files, why in (
        ([own_file(tmp_path, name="venipuncture")], "has the name of the ready exercise venipuncture"),
        ([own_file(tmp_path), own_file(tmp_path / "b")], "has the same name as"),
        ([own_file(tmp_path, name="n" * 81)], "1 to 80 characters"),
    ):
        with pytest.raises(ConfigurationError, match=why):
            Exercises(files)
    assert Exercises(["venipuncture"]).names() == exercise_names()


COMMAND = ["run", "--no-browser", "--device", "simulated"]


def test_the_command_line_tells_what_is_wrong_with_a_file_before_anything_runs(tmp_path, punctura):
    bad = own_file(tmp_path, HEAD.replace("front vein wall", "vein") + goal("reach", depth_mm=-3))
    done = punctura(*COMMAND, "--exercise", bad)
    assert done.status == 2 and "mine.toml" in done.stderr and "Traceback" not in done.stderr
    assert all(words in done.stderr for words in ("goal[0].depth_mm", "-3", "must be at least 0.1 mm"))
    bad.write_text("a = " + 500 * "[" + 500 * "]", encoding="utf-8")
    done = punctura(*COMMAND, "--exercise", bad)
    assert done.status == 2 and "nested more than" in done.stderr
    done = punctura(*COMMAND, "--exercise", tmp_path / "none.toml")
    assert done.status == 2 and "no such file" in done.stderr
    done = punctura(*COMMAND, "--headless", "--exercise", bad)
    assert done.status == 2 and "is an option of the page" in done.stderr


def test_a_warning_is_printed_and_listed(tmp_path, own, punctura, monkeypatch):
    from punctura.studio import serve as serving

    (tmp_path / "index.html").write_text("page")
    own.write_text(own.read_text(encoding="utf-8") + goal("reach", depth_mm=2), encoding="utf-8")
    monkeypatch.setattr(serving, "run_studio", lambda *_: None)
    said = punctura(*COMMAND, "--exercise", own, "--page", tmp_path).stderr
    assert f"punctura: warning: {own}: goal[2]: is met before the front vein wall pops" in said
    (entry, *_) = Exercises([own]).overviews()
    assert [warning.path for warning in entry.warnings] == ["goal[2]"] and entry.problems == []


@pytest.mark.parametrize(("scene", "runs"), [((), "Somebody"), (("k06-fig12",), "K06 Fig. 12")])
def test_without_a_scene_that_of_the_exercise_runs(tmp_path, own, punctura, monkeypatch, scene, runs):
    from punctura.studio import serve as serving

    page = tmp_path / "page"
    page.mkdir()
    (page / "index.html").write_text("page")
    seen = []

    def look(make, browser, duration, tell):
        server = make()
        seen.append((server.session.run.loaded.scene.name, server.session.exercises.names()[0]))
        server.stop()

    monkeypatch.setattr(serving, "run_studio", look)
    asked = ["run", *scene, "--no-browser", "--device", "simulated", "--exercise", str(own), "--page", str(page)]
    assert punctura(*asked, "--recordings", tmp_path / "kept").status == 0 and seen == [(runs, "mine")]


def test_the_depths_of_the_space_are_listed(tmp_path):
    text = HEAD.replace('in_front_of = "back vein wall"', "depth_mm = 1\ndeepest_mm = 2.5") + goal("reach")
    (entry, *_) = Exercises([own_file(tmp_path, text)]).overviews()
    assert entry.space == [1] and np.allclose([entry.space_from, entry.space_to], [1e-3, 2.5e-3])
    assert entry.goal_from == entry.space_from


def test_the_depth_of_the_reach_goal_is_listed(tmp_path):
    text = HEAD.replace("[space]", "[space]\ndepth_mm = 1") + goal("stay", seconds=1) + goal("reach", depth_mm=2)
    (entry, *_) = Exercises([own_file(tmp_path, text)]).overviews()
    assert np.allclose([entry.space_from, entry.goal_from], [1e-3, 2e-3])


@pytest.mark.parametrize(
    ("second", "told"),
    [
        (
            SecondDevice("simulated"),
            "At the force scale of 0.055, push the plunger with clearly more than 2.3 N: with less, the thumb",
        ),
        (None, "The thumb is a key here and feels nothing, so the plunger is judged by the model's force."),
    ],
)
def test_the_list_and_the_judge_know_whether_the_thumb_is_on_a_second_device(tmp_path, monkeypatch, second, told):
    attempts = []

    def attempt(exercise, scene, second_device, simulated):
        attempts.append((second_device, simulated))
        return Attempt(exercise, scene, second_device, simulated)

    monkeypatch.setattr(activities, "Attempt", attempt)
    server = serve(tmp_path, "epidural", Settings(second=second))
    with StudioClient(server.address.url) as page:
        page.wait(lambda: page.of("scene") and page.last)
        said = {entry["name"]: (entry["unfelt"], entry["note"]) for entry in page.json("/api/exercises")}
        unfelt, note = said.pop("epidural-plunger")
        assert (unfelt or note).startswith(told) and bool(note) == (second is None) and not (unfelt and note)
        assert set(said.values()) == {("", "")}
        assert page.ask(do="start_exercise", exercise="epidural-plunger")["ok"]
        assert attempts == [(second is not None, True)]
        assert page.ask(do="end_exercise")["ok"]
    server.stop()

"""Exercises that are made in the page: checked by the code of files, kept in one folder, and in no other place."""

import threading

import pytest
from punctura._core import ForceLimits
from punctura.exercise import exercise_names, exercise_of, load_exercise
from punctura.exercise.text import exercise_text
from punctura.studio import catalog
from punctura.studio.catalog import Exercises
from punctura.studio.limits import MOST_OWN_EXERCISES
from punctura.studio.own_exercises import OwnExercises

TABLES = {
    "title": 'A "quoted" \u00e4 title', "description": "Two\nlines.", "instruction": "Push.", "scene": "venipuncture",
    "start": {"position_mm": [0, 5, 0]},
    "space": {"name": "the vein", "behind": "front vein wall", "in_front_of": "back vein wall"},
    "goal": [{"kind": "reach"}, {"kind": "stay", "seconds": 2.5, "whole_tip": False}],
}  # fmt: skip


def names(page):
    return [entry["name"] for entry in page.json("/api/exercises")]


@pytest.mark.parametrize("name", exercise_names())
def test_a_file_that_is_written_anew_is_the_same_exercise(name, tmp_path):
    exercise = load_exercise(name)
    path = tmp_path / "again.toml"
    path.write_text(exercise_text(exercise.file), encoding="utf-8")
    assert load_exercise(path).file == exercise.file


def test_an_exercise_is_checked_saved_listed_and_deleted(page, served):
    checked = page.ask(do="check_exercise", tables=TABLES)
    assert checked["ok"] and 'behind = "front vein wall"' in checked["data"]["toml"]
    saved = page.ask(do="save_exercise", name="mine", tables=TABLES)
    assert saved["ok"], saved
    folder = served.session.shelf.folder / "exercises"
    assert load_exercise(folder / "mine.toml").title == TABLES["title"]
    entry = page.json("/api/exercises")[0]
    assert (entry["name"], entry["made"], entry["problems"]) == ("mine", True, [])
    assert page.ask(do="start_exercise", exercise="mine")["ok"]
    assert "already" in page.ask(do="save_exercise", name="mine", tables=TABLES)["text"]
    assert page.ask(do="save_exercise", name="mine", tables=TABLES | {"title": "New"}, replace=True)["ok"]
    assert page.json("/api/exercises")[0]["title"] == "New"
    assert page.ask(do="delete_exercise", name="mine")["ok"]
    assert names(page) == exercise_names() and list(folder.iterdir()) == []
    assert not page.ask(do="delete_exercise", name="mine")["ok"]


def test_problems_come_with_their_place_and_nothing_is_saved(page, served):
    wrong = TABLES | {"goal": [{"kind": "stay", "seconds": -1}], "scene": "/etc/passwd"}
    for request in ({"do": "check_exercise"}, {"do": "save_exercise", "name": "mine"}, {"do": "try_exercise"}):
        refused = page.ask(**request, tables=wrong)
        assert not refused["ok"]
        assert {"scene", "goal[0].seconds"} <= {problem["path"] for problem in refused["problems"]}
    assert not (served.session.shelf.folder / "exercises").exists()


@pytest.mark.parametrize("name", ["../mine", "a/b", ".hidden", "con", "venipuncture", "draft", "x" * 80 + "/"])
def test_a_name_cannot_leave_the_folder_or_hide_another_exercise(page, served, name):
    if len(name) <= 80:
        assert not page.ask(do="save_exercise", name=name, tables=TABLES)["ok"]
        assert not page.ask(do="delete_exercise", name=name)["ok"]
    assert not list(served.session.shelf.folder.rglob("*.toml"))


def test_links_are_not_followed_and_the_number_of_files_is_limited(page, served, tmp_path):
    folder = served.session.shelf.folder / "exercises"
    folder.mkdir(parents=True)
    outside = tmp_path / "outside.toml"
    outside.write_text("secret", encoding="utf-8")
    (folder / "link.toml").symlink_to(outside)
    assert "link" not in names(page)
    assert not page.ask(do="save_exercise", name="link", tables=TABLES, replace=True)["ok"]
    assert not page.ask(do="delete_exercise", name="link")["ok"]
    assert outside.read_text(encoding="utf-8") == "secret"
    for number in range(MOST_OWN_EXERCISES):
        (folder / f"e{number:03}.toml").write_text("", encoding="utf-8")
    (folder / "zz-copied.toml").write_text("", encoding="utf-8")
    assert "zz-copied" in names(page)  # no file is hidden
    assert "delete one first" in page.ask(do="save_exercise", name="one-more", tables=TABLES)["text"]


def test_two_pages_that_save_at_once_do_not_exceed_the_number_of_files(tmp_path, monkeypatch):
    monkeypatch.setattr("punctura.studio.own_exercises.MOST_OWN_EXERCISES", 3)
    own, exercise, refused = OwnExercises(tmp_path), load_exercise("venipuncture"), []

    def save(number):
        try:
            own.save(f"e{number}", exercise, replace=False)
        except ValueError as error:
            refused.append(str(error))

    threads = [threading.Thread(target=save, args=[number]) for number in range(12)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(own.files()) == 3 and len(refused) == 9


def test_a_file_is_read_again_only_when_it_has_changed(tmp_path, monkeypatch):
    exercises, read = Exercises(), []
    exercises.own = OwnExercises(tmp_path)
    path = exercises.own.save("mine", exercise_of(TABLES, "mine"), replace=False)
    monkeypatch.setattr(catalog, "load_exercise", lambda file: (read.append(file), load_exercise(file))[1])
    limits = ForceLimits()
    titles = [exercises.overviews(limits)[0].title for _ in range(3)]
    assert titles == [TABLES["title"]] * 3 and read == [path]
    exercises.own.save("mine", exercise_of(TABLES | {"title": "New"}, "mine"), replace=True)
    assert exercises.overviews(limits)[0].title == "New" and read == [path] * 2
    path.write_text("", encoding="utf-8")
    assert exercises.overviews(limits)[0].problems


def test_an_exercise_is_tried_before_it_is_saved(page):
    assert page.ask(do="try_exercise", tables=TABLES, person="Ada")["ok"]
    page.wait(lambda: page.of("exercise")[-1]["running"])
    assert page.of("exercise")[-1]["exercise"] == "draft"
    assert names(page)[0] == "draft"
    assert page.ask(do="end_exercise")["ok"]


def test_the_ready_scenes_come_with_their_membranes(page):
    scenes = {scene["name"]: scene for scene in page.json("/api/scenes")}
    assert [membrane["name"] for membrane in scenes["k06-fig12"]["membranes"]] == ["first membrane", "second membrane"]
    assert scenes["k06-fig12"]["tip_length"] == pytest.approx(3.76e-3, abs=1e-5)

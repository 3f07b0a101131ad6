"""Exercises that are made in the page: checked by the code of files, kept in one folder, and in no other place."""

import base64
import errno
import os
import threading

import pytest
from punctura._core import ForceLimits
from punctura.errors import FREE_SPACE, ConfigurationError
from punctura.exercise import exercise_names, exercise_of, load_exercise
from punctura.exercise.exercise import exercise_text
from punctura.scene import scene_path
from punctura.studio import catalog
from punctura.studio.catalog import Exercises
from punctura.studio.client import StudioClient
from punctura.studio.limits import MOST_OWN_EXERCISES, MOST_TEXT
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


def sent(text, name="mine", **more):
    data = text if isinstance(text, bytes) else text.encode("utf-8")
    return {"do": "open_exercise", "name": name, "file": base64.b64encode(data).decode(), **more}


TEXT = "# From the course of spring.\n" + exercise_text(exercise_of(TABLES, "mine").file)


def test_a_file_is_opened_kept_as_it_is_listed_and_started(page, served):
    opened = page.ask(**sent(TEXT))
    assert opened["ok"] and opened["data"] == {"name": "mine"}, opened
    path = served.session.shelf.folder / "exercises" / "mine.toml"
    assert path.read_text(encoding="utf-8") == TEXT  # with its comments
    entry = page.json("/api/exercises")[0]
    assert (entry["name"], entry["title"], entry["made"], entry["problems"]) == ("mine", TABLES["title"], True, [])
    assert page.ask(do="start_exercise", exercise="mine")["ok"]
    page.wait(lambda: page.of("exercise")[-1]["running"])
    assert page.ask(do="end_exercise")["ok"]


def test_a_name_that_exists_is_replaced_only_if_the_page_says_so(page, served):
    assert page.ask(**sent(TEXT))["ok"]
    refused = page.ask(**sent(TEXT.replace("spring", "autumn")))
    assert not refused["ok"] and refused["data"] == {"exists": 1} and "replace it" in refused["text"]
    path = served.session.shelf.folder / "exercises" / "mine.toml"
    assert "spring" in path.read_text(encoding="utf-8")
    assert page.ask(**sent(TEXT.replace("spring", "autumn"), replace=True))["ok"]
    assert "autumn" in path.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("data", "places", "reason"),
    [
        (b"title = ", [""], "is not TOML"),
        (b"\xff\xfetitle", [""], "is not UTF-8 text; save it as UTF-8"),
        (b"\0\0\0", [""], "is not TOML"),
        (b"a = " + b"[" * 5000, [""], "nested"),
        (scene_path("k06-fig12").read_bytes(), [""], "is a scene file, not an exercise file"),
        (TEXT.encode() + b"# " + b"x" * MOST_TEXT, [""], "is larger than 64 kB: no exercise needs that"),
        (b"", ["title", "start", "space", "goal"], "is missing"),
        (TEXT.replace("2.5", "-1").encode(), ["goal[1].seconds"], "must be at least 0.01 s"),
        (TEXT.replace("[0, 5, 0]", "[0.0, 5.0, 0.0]").replace("5.0", "9" * 500).encode(), ["start.position_mm"], ""),
        (TEXT.replace('"venipuncture"', '"../x.toml"').encode(), ["scene"], "must be one of the ready scenes"),
    ],
)
def test_a_bad_file_is_refused_with_the_words_of_the_command(page, served, tmp_path, data, places, reason):
    refused = page.ask(**sent(data))
    assert not refused["ok"] and not (served.session.shelf.folder / "exercises").exists()
    told = {problem["path"]: problem["reason"] for problem in refused["problems"]}
    assert all(any(path.startswith(place) for path in told) for place in places), told
    assert any(reason in why for why in told.values()), told
    if "64 kB" in reason or "ready scenes" in reason:
        return  # the command takes up to 256 KiB, and scene files beside the exercise
    path = tmp_path / "mine.toml"
    path.write_bytes(data)
    with pytest.raises(ConfigurationError) as bad:
        load_exercise(path)
    assert {problem.reason for problem in bad.value.problems} == set(told.values())


@pytest.mark.parametrize("name", ["../mine", "a/b", "c:\\mine", ".hidden", "con", "venipuncture", "draft"])
def test_an_opened_file_cannot_leave_the_folder_or_hide_another_exercise(page, served, name):
    for replace in (False, True):
        refused = page.ask(**sent(TEXT, name, replace=replace))
        assert not refused["ok"] and not refused["data"] and "name" in refused["text"]
    assert not list(served.session.shelf.folder.rglob("*.toml"))


def test_what_is_no_base64_is_refused_and_a_page_without_control_opens_nothing(page, served):
    assert "base64" in page.ask(do="open_exercise", name="mine", file="%%%")["text"]
    with StudioClient(served.address.url) as viewer:
        viewer.wait(lambda: viewer.of("control"))
        assert "control" in viewer.ask(**sent(TEXT))["text"]
    assert not (served.session.shelf.folder / "exercises").exists()


def test_a_full_disk_is_told_with_the_file_and_without_the_number_of_the_error(page, served, monkeypatch):
    def full(path, data, replace=True):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))

    monkeypatch.setattr("punctura.studio.own_exercises.write_whole", full)
    path = served.session.shelf.folder / "exercises" / "mine.toml"
    assert page.ask(**sent(TEXT))["text"] == f"{path}: {os.strerror(errno.ENOSPC)}; {FREE_SPACE}"

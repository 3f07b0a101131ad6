"""Exercise files: their content, and the report of all problems at once."""

import math
import os

import pytest
from attempts import HEAD, goal
from punctura import ConfigurationError, save_scene
from punctura.exercise import exercise_json_schema, exercises, load_exercise
from punctura.exercise.goals import GOALS


def problems(path):
    with pytest.raises(ConfigurationError) as error:
        load_exercise(path)
    return {problem.path: problem.reason for problem in error.value.problems}


def test_a_sound_file_gives_its_exercise_in_si(write):
    exercise = load_exercise(write(goal("stay", seconds=2, whole_tip=True), goal("time_limit", seconds=9)))
    assert (exercise.name, exercise.title, exercise.description, exercise.instruction) == (
        "test", "Test", "A test.", "Do it.",
    )  # fmt: skip
    assert (exercise.scene_name, exercise.scene.name, exercise.space) == ("venipuncture", "Venipuncture", (1, 2))
    assert exercise.start_position == (0, 0.005, 0)
    assert exercise.start_axis == pytest.approx((0, -1, 0))
    assert [g.kind for g in exercise.goals] == ["stay", "time_limit"]


def test_the_needle_points_at_the_angle_to_the_skin_that_the_file_says(write):
    head = HEAD.replace("[space]", "angle_deg = 25\nheading = [0, 0, -2]\n[space]")
    axis = load_exercise(write(goal("reach"), head=head)).start_axis
    assert axis == pytest.approx((0, -math.sin(math.radians(25)), -math.cos(math.radians(25))))


@pytest.mark.parametrize("exercise", exercises(), ids=lambda e: e.name)
def test_the_needle_of_a_ready_exercise_waits_in_front_of_the_skin_and_points_into_the_space(exercise):
    skin = exercise.scene.membranes[0]
    distance = -(exercise.start_position[1] - skin.point[1])
    assert distance < -2e-3
    assert exercise.start_axis[1] < 0
    assert exercise.start_axis[2] == 0


def test_everything_that_is_wrong_is_told_at_once(write):
    head = (
        HEAD.replace('title = "Test"', "titel = 3").replace("[0, 5, 0]", "[0, 5]").replace("[space]", "x = 1\n[space]")
    )
    wrong = write(
        goal("stay", seconds=-1),
        goal("fly"),
        goal("never_pass"),
        goal("entries", at_most=0),
        goal("reach", whole_tip="yes"),
        "[[goal]]\nseconds = 3\n",
        head=head,
    )
    found = problems(wrong)
    assert found["title"] == "is missing"
    assert found["titel"] == "unknown key; did you mean title?"
    assert found["start.x"] == "unknown key; known here: position_mm, angle_deg, heading"
    assert found["start.position_mm"] == "must be three numbers, [x, y, z]"
    assert found["goal[0].seconds"] == "must be at least 0.01 s"
    assert found["goal[1].kind"].startswith("must be one of reach, stay, never_pass, stop_after_pop")
    assert found["goal[5].kind"] == found["goal[1].kind"]
    assert found["goal[2].membrane"] == "is missing"
    assert found["goal[3].at_most"] == "must be at least 1"
    assert found["goal[4].whole_tip"] == "must be true or false"


def test_names_and_depths_are_checked_beside_keys_that_are_wrong(write):
    head = HEAD.replace('"front vein wall"', '"vein"').replace("[space]", "x = 1\n[space]\nsigns = 3\ndepth_mm = 3")
    head = head.replace("[0, 5, 0]", "[0, -9, 0]").replace('title = "Test"\n', "") + "deepest_mm = 2\n"
    goals = goal("never_pass", membrane="dura", whole=3), goal("peak_force", at_most_N="x"), goal("entries", at_most=0)
    assert problems(write(*goals, head=head)).keys() == {
        "title", "start.x", "start.position_mm", "space.signs", "space.behind", "space.deepest_mm", "goal[0].whole",
        "goal[0].membrane", "goal[1].at_most_N", "goal[2].at_most", "goal",
    }  # fmt: skip


def test_what_needs_no_scene_is_checked_beside_a_scene_that_is_not_there(write):
    head = HEAD.replace('"venipuncture"', '"none.toml"') + "depth_mm = 3\ndeepest_mm = 2\n"
    assert problems(write(goal("entries", at_most=1), head=head)).keys() == {"scene", "space.deepest_mm", "goal"}


@pytest.mark.parametrize(
    ("old", "new", "path", "words"),
    [
        ('title = "Test"', 'title = ""', "title", "must not be empty"),
        ('title = "Test"', "title = 3", "title", "must be text, in quotes"),
        ('title = "Test"', f'title = "{"x" * 201}"', "title", "must have at most 200 characters"),
        ("[0, 5, 0]", '[0, "5", 0]', "start.position_mm[1]", "must be a number"),
        ("[0, 5, 0]", "[0, nan, 0]", "start.position_mm[1]", "must be a finite number"),
        ("[0, 5, 0]", "5", "start.position_mm", "must be three numbers, [x, y, z]"),
        ("[0, 5, 0]", "[0, 5, 0]\nangle_deg = 5", "start.angle_deg", "must be more than 10 deg"),
        ("[start]", "[origin]", "origin", "unknown key; known here: title, description, instruction, scene, level, "),
        ("[start]", "[begin]", "start", "is missing; write a table [start]"),
        ("[[goal]]", "[[aim]]", "goal", "is missing; write a table [[goal]]"),
        ("seconds = 3", "time_s = 3", "goal[0].time_s", "unknown key; known here: text, kind, seconds, whole_tip"),
        ("seconds = 3", "secnds = 3", "goal[0].secnds", "unknown key; did you mean seconds?"),
    ],
)
def test_each_problem_is_told_in_plain_words(write, old, new, path, words):
    text = HEAD + goal("stay", seconds=3)
    assert old in text
    assert problems(write(head=text.replace(old, new)))[path].startswith(words)


def test_what_does_not_fit_the_scene_is_told_at_once(write):
    head = HEAD.replace("front vein wall", "vein").replace("[space]", "angle_deg = 30\nheading = [0, 3, 0]\n[space]")
    found = problems(write(goal("never_pass", membrane="dura"), goal("time_limit", seconds=3), head=head))
    assert found["space.behind"] == "must be one of the scene's membranes: skin, front vein wall, back vein wall"
    assert found["goal[0].membrane"] == found["space.behind"]
    assert found["goal"].startswith("at least one goal must be of kind reach or stay")
    assert found["start.heading"] == "must not be parallel to the first membrane's normal"


def test_a_space_between_a_membrane_and_itself_is_none(write):
    head = HEAD.replace("back vein wall", "front vein wall")
    assert "another membrane" in problems(write(goal("reach"), head=head))["space.in_front_of"]


def test_a_scene_that_is_not_there_or_is_wrong_is_reported(write, tmp_path):
    assert "no such file" in problems(write(goal("reach"), head=HEAD.replace('"venipuncture"', '"mine.toml"')))["scene"]
    (tmp_path / "mine.toml").write_text("name = 'x'\n")
    refusal = problems(write(goal("reach"), head=HEAD.replace('"venipuncture"', '"mine.toml"')))["scene"]
    assert "needle" in refusal and "membrane" in refusal


def test_a_scene_may_lie_beside_the_exercise(write, tmp_path):
    save_scene(load_exercise("venipuncture").scene, tmp_path / "mine.toml")
    exercise = load_exercise(write(goal("reach"), head=HEAD.replace('"venipuncture"', '"mine.toml"')))
    assert exercise.scene == load_exercise("venipuncture").scene
    assert exercise.scene_name == os.fspath(tmp_path / "mine.toml")


def test_files_that_are_none_are_reported(tmp_path):
    with pytest.raises(ConfigurationError, match="ready exercises: steady-push, stop-after-pop"):
        load_exercise("lumbar")
    with pytest.raises(ConfigurationError, match="no such file"):
        load_exercise(tmp_path / "none.toml")
    with pytest.raises(ConfigurationError, match="is a folder, not an exercise file"):
        load_exercise(tmp_path)
    (tmp_path / "bad.toml").write_text("title = ")
    with pytest.raises(ConfigurationError, match="is not TOML"):
        load_exercise(tmp_path / "bad.toml")


@pytest.mark.parametrize("text", ["goal = 3\n", "goal = [3]\n", "[goal]\nkind = 'reach'\n", "[[goal]]\nkind = 3\n"])
def test_goals_that_are_no_tables_are_reported(tmp_path, text):
    (tmp_path / "odd.toml").write_text(text)
    found = problems(tmp_path / "odd.toml")
    words = "must be a list of one or more tables", "must be a table, [[goal]]", "must be one of reach, stay"
    assert any(path.startswith("goal") and reason.startswith(words) for path, reason in found.items())


def test_the_schema_names_every_kind_of_goal_and_the_label_of_its_field():
    tables = [exercise_json_schema()["$defs"][goal.__name__] for goal in GOALS.values()]
    assert [table["properties"]["kind"]["const"] for table in tables] == list(GOALS)
    keys = {kind: table["properties"].values() for kind, table in zip(GOALS, tables, strict=True)}
    labels = {kind: [key["x-label"] for key in each if "x-label" in key] for kind, each in keys.items()}
    assert labels.pop("reach") == labels.pop("on_line") == []  # the form draws them, or has no field for them
    assert all(len(each) == 1 for each in labels.values()) and labels["time_limit"] == ["Time limit, s"]
    assert [kind for kind, table in zip(GOALS, tables, strict=True) if table["x-syringe"]] == [
        "stop_plunger",
        "feel_plunger",
    ]

"""Goals at a depth behind a membrane without another one behind it, and goals that conflict with the tip's length."""

import json
import math
import re
from pathlib import Path

import numpy as np
import punctura as pn
import pytest
from attempts import HEAD, goal, ideal, judged
from punctura import ConfigurationError
from punctura.exercise import exercise_json_schema, exercises, load_exercise
from runs import moved

SCENE = pn.load_scene("venipuncture")  # walls of 0.4 mm at -4.81 and -8.22
TIP = 0.8e-3 / math.tan(math.radians(11))  # m
OPEN = HEAD.replace('in_front_of = "back vein wall"\n', "")
PAST = """
title = "Three past the second"
description = "No third membrane is needed."
instruction = "Push."
scene = "k06-fig12"
[start]
position_mm = [0, 5, 0]
[space]
name = "3 mm past the second membrane"
behind = "second membrane"
depth_mm = 3
deepest_mm = 5
"""


def arrived_at(write, head, *goals, to=-20.0):
    """How deep the tip is when the attempt is passed, m."""
    exercise = load_exercise(write(*goals, head=head))
    made = judged(exercise, ideal(exercise.scene, (0, 5, 0), (0, to, 0)), scene=exercise.scene)
    result = made.finish()
    assert result.passed, result.reasons
    return result.metrics.net_distance


def problems(path):
    with pytest.raises(ConfigurationError) as error:
        load_exercise(path)
    return {problem.path: problem.reason for problem in error.value.problems}


def test_three_millimetres_past_the_second_membrane_can_be_asked_for(write):
    exercise = load_exercise(write(goal("reach"), head=PAST))
    second = exercise.scene.membranes[1]
    far = -second.point[1] + second.membrane.thickness
    assert exercise.space == (1,) and exercise.space_depth == (pytest.approx(3e-3), pytest.approx(5e-3))
    assert arrived_at(write, PAST, goal("reach")) == pytest.approx(far + 3e-3, abs=1e-5)


@pytest.mark.parametrize(("whole", "more"), [(False, 0.0), (True, TIP)])
def test_a_goal_may_ask_for_more_depth_than_the_space(write, whole, more):
    reach = goal("reach", depth_mm=2.5, whole_tip=whole)
    assert arrived_at(write, OPEN, reach) == pytest.approx(5.21e-3 + 2.5e-3 + more, abs=1e-5)
    assert arrived_at(write, OPEN, goal("reach", whole_tip=whole)) == pytest.approx(5.21e-3 + more, abs=1e-5)
    text = load_exercise(write(reach, head=OPEN))
    assert judged(text, ideal(SCENE, (0, 5, 0), (0, 4, 0)), scene=SCENE).goals[0].text == (
        f"Bring the {'whole tip' if whole else 'point'} 2.5 mm past the front vein wall"
    )


def test_a_depth_is_measured_along_the_membranes_normal_however_slanted_the_needle_is(write):
    """At 30 degrees to the skin a needle goes 6 mm to be 3 mm deeper."""
    axis = np.array([math.cos(math.pi / 6), -0.5, 0.0])
    way = np.arange(-10e-3, 30e-3, 1e-5)
    columns = moved(SCENE, np.outer(way, axis), axis)
    results = []
    for depth in (0.0, 3.0):
        exercise = load_exercise(write(goal("reach"), head=OPEN.replace("[space]", f"[space]\ndepth_mm = {depth}")))
        results.append(judged(exercise, columns, scene=SCENE).finish())
    assert all(result.passed for result in results)
    near, far = (result.metrics for result in results)
    assert far.net_distance - near.net_distance == pytest.approx(6e-3, abs=2e-4)


def test_the_space_ends_at_its_deepest(write):
    """At 10 mm/s the needle is 2 mm, so 0.2 s, in a space of 2 mm."""
    exercise = load_exercise(write(goal("stay", seconds=9), head=PAST))
    made = judged(exercise, ideal(exercise.scene, (0, 5, 0), (0, -25, 0)), scene=exercise.scene)
    assert made.finish().metrics.dwell == pytest.approx(0.2, abs=2e-3)
    assert made.status.instruction == "You are more than 5 mm past the second membrane: draw back a little."


def test_without_an_end_the_space_goes_on(write):
    exercise = load_exercise(write(goal("stay", seconds=9), head=OPEN))
    m = judged(exercise, ideal(SCENE, (0, 5, 0), (0, -25, 0)), scene=SCENE).finish().metrics
    assert m.dwell == pytest.approx((25 - 5.21) / 10, abs=2e-3)


@pytest.mark.parametrize(
    ("space", "where", "why"),
    [
        (
            "depth_mm = 3.1",
            "space.depth_mm",
            "must be at most 2.91 mm: the space ends at 3.01 mm (the ",
        ),
        ("depth_mm = -1", "space.depth_mm", "must be at least 0 mm"),
        ("depth_mm = 2\ndeepest_mm = 2", "space.deepest_mm", "must be at least 2.1 mm: the space begins at 2 mm"),
        ("depth_mm = 1", "goal[0].depth_mm", "must be at least 1 mm, where the space begins (space.depth_mm)"),
        ("deepest_mm = 0.4", "goal[0].depth_mm", "must be less than 0.4 mm, where the space ends (space.deepest_mm)"),
    ],
)
def test_a_depth_that_nobody_can_come_to_is_reported(write, space, where, why):
    head = HEAD.replace("[space]", f"[space]\n{space}")
    assert why in problems(write(goal("reach", depth_mm=0.5), head=head))[where]


def test_a_wall_that_is_not_there_cannot_be_pressed(write):
    head = OPEN.replace("[space]", "[space]\npress_mm = 1")
    assert "needs space.in_front_of" in problems(write(goal("reach"), head=head))["space.press_mm"]


def test_the_schema_has_the_depths():
    schema = exercise_json_schema()
    space, reach = schema["$defs"]["Space"], schema["$defs"]["Reach"]
    assert {"depth_mm", "deepest_mm"} <= set(space["properties"]) and "in_front_of" not in space["required"]
    assert "depth_mm" in reach["properties"]
    json.dumps(schema)


DOCS = Path(__file__).parents[3] / "docs" / "exercises.md"
EXAMPLES = re.findall(r"```toml exercise.*?\n(.*?)```", DOCS.read_text(encoding="utf-8"), re.DOTALL)


@pytest.mark.parametrize("text", EXAMPLES)
def test_each_example_of_the_docs_is_a_sound_exercise(tmp_path, text):
    (tmp_path / "example.toml").write_text(text, encoding="utf-8")
    assert load_exercise(tmp_path / "example.toml").goals


@pytest.fixture
def docs_example(tmp_path):
    """The example of the docs that asks for 3 mm past the second membrane."""
    (tmp_path / "example.toml").write_text(next(text for text in EXAMPLES if "depth_mm = 3" in text), encoding="utf-8")
    return load_exercise(tmp_path / "example.toml")


def past_the_second(exercise, depth):
    """The result of going to this depth of the point behind the second membrane, mm, at 5 mm/s, and resting there."""
    second = exercise.scene.membranes[1]
    far = (second.membrane.thickness - second.point[1]) * 1e3
    columns = ideal(exercise.scene, (0, 5, 0), (0, -far - depth, 0), speed=5e-3, stops=4)
    return judged(exercise, columns, scene=exercise.scene).finish()


def test_the_docs_three_millimetres_past_the_second_membrane_can_be_passed(docs_example):
    needle = docs_example.scene.needle
    tip = needle.diameter / math.tan(needle.tip_angle) * 1e3
    for depth, passed in ((3.5, False), (tip + 2.9, False), (tip + 3.1, True), (8.9, True), (9.1, False)):
        result = past_the_second(docs_example, depth)
        assert result.passed is passed, (depth, result.reasons)
        if passed:
            assert any(event.what == "pop" and event.membrane == 1 for event in result.events)
    assert f"is {tip + 3:.2f} mm deep when" in DOCS.read_text(encoding="utf-8") and docs_example.warnings == ()


OPEN = HEAD.replace('in_front_of = "back vein wall"\n', "")  # an upright needle, whose tip is 4.12 mm long
SLANTED = OPEN.replace("[space]", "angle_deg = 30\n[space]")  # 2.06 mm along the membrane's normal


def warned(write, *goals, head=OPEN, space=""):
    path = write(*goals, head=head.replace("[space]", f"[space]\n{space}"))
    return {warning.path: warning.reason for warning in load_exercise(path).warnings}


def test_a_depth_that_is_reached_before_the_pop_gives_a_warning(write):
    noted = warned(write, goal("stay", seconds=1), goal("reach", depth_mm=3))
    assert noted == {
        "goal[1]": "is met before the front vein wall pops: the point is then 3 mm past it, and the tip is 4.12 mm "
        "long in this direction; add whole_tip = true if all of the tip must be past it"
    }
    assert warned(write, goal("stay", seconds=1), space="depth_mm = 3").keys() == {"goal[0]"}
    assert warned(write, goal("reach", depth_mm=3), head=SLANTED) == {}


@pytest.mark.parametrize(
    "fits", [goal("reach", depth_mm=4.2), goal("reach", depth_mm=3, whole_tip=True), goal("reach")]
)
def test_no_warning_where_the_tip_is_through_or_only_the_point_counts(write, fits):
    assert warned(write, fits) == {}


def test_a_space_that_is_too_narrow_for_the_whole_tip_gives_a_warning(write):
    narrow = warned(write, goal("stay", seconds=1, whole_tip=True), space="deepest_mm = 4")["goal[0].whole_tip"]
    assert "only when the point is at 4.12 mm, and the space ends at 4 mm, by space.deepest_mm" in narrow
    whole = goal("reach", whole_tip=True)
    assert warned(write, whole, space="deepest_mm = 4", head=SLANTED) == {}
    assert warned(write, whole, head=HEAD).keys() == {"goal[0].whole_tip"}  # the vein, with an upright needle
    limit = warned(write, whole, goal("depth", at_most_mm=2), space="deepest_mm = 4", head=SLANTED)
    assert limit["goal[0].whole_tip"].endswith("the point is at 2.06 mm, and a goal lets the point come to 2 mm")
    assert warned(write, whole, goal("depth", at_most_mm=2.5), head=SLANTED) == {}


def test_the_ready_exercises_give_no_warning():
    assert not any(exercise.warnings for exercise in exercises())

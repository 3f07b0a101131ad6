"""An exercise file with unreasonable numbers is rejected, with path, value and bound."""

import json

import pytest
from attempts import HEAD, goal
from punctura import ConfigurationError, load_scene
from punctura.exercise import exercise_json_schema, load_exercise

DEPTHS = HEAD.replace('in_front_of = "back vein wall"\n', "")
START, SPACE = "[0, 5, 0]", "[space]"


def problem(path):
    with pytest.raises(ConfigurationError) as error:
        load_exercise(path)
    (only,) = error.value.problems
    return only


@pytest.mark.parametrize(
    ("goals", "path", "value", "bound"),
    [
        (goal("reach", depth_mm=1e300), "depth_mm", 1e300, "must be at most 200 mm"),
        (goal("reach", depth_mm=1e-12), "depth_mm", 1e-12, "must be at least 0.1 mm"),
        (goal("stop_after_pop", membrane="skin", within_mm=1e-300), "within_mm", 1e-300, "must be at least 0.1 mm"),
        (goal("stop_after_pop", membrane="skin", within_mm=201), "within_mm", 201, "must be at most 200 mm"),
        (goal("stay", seconds=1e-9), "seconds", 1e-9, "must be at least 0.01 s"),
        (goal("stay", seconds=3601), "seconds", 3601, "must be at most 3600 s"),
        (goal("time_limit", seconds=1e300), "seconds", 1e300, "must be at most 3600 s"),
        (goal("peak_force", at_most_N=1e-9), "at_most_N", 1e-9, "must be at least 0.001 N"),
        (goal("peak_force", at_most_N=1e9), "at_most_N", 1e9, "must be at most 1000 N"),
        (goal("entries", at_most=1001), "at_most", 1001, "must be at most 1000"),
    ],
)
def test_an_unreasonable_limit_is_rejected(write, goals, path, value, bound):
    assert problem(write(goals, goal("reach"), head=DEPTHS)) == (f"goal[0].{path}", value, bound)


@pytest.mark.parametrize(
    ("given", "bound"),
    [
        ([0, 1e300, 0], "must be at most 500 mm from the scene's origin; it is 1e+300 mm from it"),
        ([400, 301, 0], "must be at most 500 mm from the scene's origin; it is 500.6 mm from it"),
        ([0, -50, 0], "must be at least 0.1 mm in front of every membrane; it is 50 mm behind the skin"),
        ([0, 0.05, 0], "must be at least 0.1 mm in front of every membrane; it is 0.05 mm in front of the skin"),
    ],
)
def test_the_needle_waits_near_the_scene_and_in_front_of_it(write, given, bound):
    assert problem(write(goal("reach"), head=HEAD.replace(START, str(given)))) == ("start.position_mm", given, bound)
    assert load_exercise(write(goal("reach"), head=HEAD.replace(START, "[300, 400, 0]"))).start_position[1] == 0.4


@pytest.mark.parametrize("given", [[0, 0, 0], [1e300, 0, 0], [1e-12, 0, 0]])
def test_a_heading_is_a_direction(write, given):
    head = HEAD.replace(SPACE, f"angle_deg = 30\nheading = {given}\n{SPACE}")
    found = problem(write(goal("reach"), head=head))
    assert found == ("start.heading", given, "must be a direction whose length is from 0.001 to 1000")


@pytest.mark.parametrize(
    ("space", "path", "value", "bound"),
    [
        ("deepest_mm = 1e-12", "deepest_mm", 1e-12, "must be at least 0.1 mm"),
        ("deepest_mm = 1e6", "deepest_mm", 1e6, "must be at most 200 mm"),
        ("depth_mm = 1e300", "depth_mm", 1e300, "must be at most 200 mm"),
        ("depth_mm = 2\ndeepest_mm = 2.05", "deepest_mm", 2.05, "must be at least 2.1 mm: the space begins at 2 mm"),
    ],
)
def test_a_space_is_as_wide_and_as_deep_as_a_needle_can_tell(write, space, path, value, bound):
    found = problem(write(goal("reach"), head=DEPTHS.replace(SPACE, f"{SPACE}\n{space}")))
    assert found[:2] == (f"space.{path}", value) and found.reason.startswith(bound)


def test_walls_that_touch_leave_no_space(write):
    skin = load_scene("venipuncture").membranes[0]
    head = HEAD.replace('in_front_of = "back vein wall"', f'in_front_of = "{skin.name}"')
    found = problem(write(goal("reach"), head=head))
    assert found.path == "space.in_front_of"
    assert found.reason.startswith("does not begin behind the front vein wall; the space between them must be at least")


def test_a_depth_on_the_bound_is_no_problem(write):
    head = DEPTHS.replace(SPACE, f"{SPACE}\ndepth_mm = 199.9\ndeepest_mm = 200")
    assert load_exercise(write(goal("reach"), head=head)).space_depth == pytest.approx((0.1999, 0.2))


def test_the_schema_tells_the_bounds():
    text = json.dumps(exercise_json_schema()["$defs"]["Reach"])
    assert '"maximum": 200.0' in text and '"minimum": 0.1' in text

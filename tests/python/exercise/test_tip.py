"""A goal that conflicts with the length of the tip gives a warning."""

import pytest
from attempts import HEAD, goal
from punctura.exercise import exercises, load_exercise

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


def test_the_ready_exercises_give_no_warning():
    assert not any(exercise.warnings for exercise in exercises())

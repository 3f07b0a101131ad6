"""The goals of how the needle is moved: each is met, missed and not measured where it should be."""

import numpy as np
import punctura as pn
import pytest
from attempts import HEAD, goal, ideal, judged
from punctura import ConfigurationError
from punctura.exercise import load_exercise

SCENE = pn.load_scene("venipuncture")
DEEP = HEAD.replace('in_front_of = "back vein wall"\n', "deepest_mm = 6\n")
DOWN = (0, 5, 0), (0, -7, 0)  # the point comes 1.8 mm behind the front wall
LEAN = np.array([np.cos(np.radians(80)), -np.sin(np.radians(80)), 0.0])


def of(write, columns, asked, cuts=160):
    made = judged(load_exercise(write(goal("stay", seconds=0.5), asked, head=DEEP)), columns, cuts, SCENE).finish()
    return made.goals[1].state, " ".join(made.reasons), made.goals[1].text


def straight(speed=10e-3):
    return ideal(SCENE, *DOWN, speed=speed, stops=1)


def leaning():
    columns = straight()
    n = len(columns["tick"])
    turned = np.tile(LEAN, (n, 1))
    return columns | {"axis": turned, "direction": np.tile(turned[:, None], (1, len(SCENE.membranes), 1))}


def sliding():
    columns = straight()
    return columns | {"tip": columns["tip"] + np.clip(columns["time"] - 0.8, 0, 0.5)[:, None] * [0, 0, 10e-3]}


def waiting(seconds):
    """A needle that stops on the way, 3 mm deep."""
    parts = ideal(SCENE, (0, 5, 0), (0, -3, 0), stops=seconds), ideal(SCENE, (0, -3, 0), (0, -7, 0), stops=1)
    columns = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    n = len(columns["tick"])
    return columns | {"tick": np.arange(n), "time": np.arange(n) / SCENE.servo.rate}


GOALS = {
    "entry_angle": (goal("entry_angle", within_deg=5), straight, leaning, "You entered at 80 degrees; 90 are asked"),
    "straight": (
        goal("straight", within_mm=1), straight, sliding, "The tip went more than 1.0 mm to the side of its line"
    ),
    "speed": (
        goal("speed", at_most_mm_per_s=20), straight, lambda: straight(30e-3), "You pushed in faster than 20 mm/s"
    ),
    "no_pause": (
        goal("no_pause", seconds=1), lambda: waiting(0.9), lambda: waiting(1.1),
        "You stood still for 1 s before you reached the vein",
    ),
    "depth": (
        goal("depth", at_most_mm=2), straight, lambda: ideal(SCENE, DOWN[0], (0, -8, 0), stops=1),
        "The point went more than 2 mm past the front vein wall",
    ),
}  # fmt: skip


@pytest.mark.parametrize("cuts", [29, 100_000])
@pytest.mark.parametrize("kind", GOALS)
def test_it_is_met_or_missed_with_a_reason(write, kind, cuts):
    asked, good, bad, reason = GOALS[kind]
    assert of(write, good(), asked, cuts)[0] == "met"
    state, reason_given, _ = of(write, bad(), asked, cuts)
    assert state == "missed" and reason_given.startswith(reason)


@pytest.mark.parametrize("kind", GOALS)
def test_without_readings_it_is_not_measured(write, kind):
    columns = straight()
    if kind in ("entry_angle", "straight"):
        columns |= {"axis": np.full_like(columns["axis"], np.nan), "direction": columns["direction"] * np.nan}
    else:
        keep = np.ones(len(columns["tick"]), dtype=bool)
        start = 1700 if kind == "depth" else 1200  # in the wall before the space, or on the way
        keep[start : start + 100] = False
        columns = {name: column[keep] for name, column in columns.items()}
    state, reason_given, text = of(write, columns, GOALS[kind][0])
    assert state == "not measured" and f"Not measured: “{text}”" in reason_given


def steep(turn):
    """A needle at 70 degrees to the skin, turned from the start's heading, degrees."""
    columns = straight()
    n, (along, down) = len(columns["tick"]), (np.cos(np.radians(70)), np.sin(np.radians(70)))
    axis = np.tile([along * np.cos(np.radians(turn)), -down, along * np.sin(np.radians(turn))], (n, 1))
    return columns | {"axis": axis, "direction": np.tile(axis[:, None], (1, len(SCENE.membranes), 1))}


@pytest.mark.parametrize("length", [1, 2])
@pytest.mark.parametrize(("turn", "state"), [(0, "met"), (15, "met"), (25, "missed"), (180, "missed")])
def test_the_heading_is_judged_whatever_the_tolerance_of_the_angle_and_the_length_of_the_normal(
    write, turn, state, length
):
    scene = SCENE.replace(
        membranes=[one.replace(inward_normal=[length * v for v in one.inward_normal]) for one in SCENE.membranes]
    )
    asked = goal("entry_angle", angle_deg=70, within_deg=25, turned_at_most_deg=20)
    exercise = load_exercise(write(goal("stay", seconds=0.5), asked, head=DEEP))
    assert judged(exercise, steep(turn), 160, scene).finish().goals[1].state == state


def test_the_coaching_does_not_depend_on_how_ticks_are_cut(write):
    exercise = load_exercise(write(goal("stay", seconds=0.5), goal("straight", within_mm=1), head=DEEP))
    made = [judged(exercise, sliding(), cuts, SCENE).finish().coaching for cuts in (7, 160, 100_000)]
    assert made[0] == made[1] == made[2] and made[0].change[0].about == "aside"


def test_the_angle_and_the_depth_are_those_of_the_start_and_of_the_space_if_left_out(write):
    assert (
        of(write, straight(), goal("entry_angle", within_deg=5))[2] == "Enter the skin at 90 degrees, within 5 degrees"
    )
    assert of(write, straight(), goal("entry_angle", within_deg=5, angle_deg=45))[0] == "missed"
    assert of(write, straight(), goal("depth"))[2] == "Keep the point within 6 mm of the front vein wall"
    with pytest.raises(ConfigurationError, match=r"goal\[1\].at_most_mm: is needed: the space has no deepest_mm"):
        load_exercise(write(goal("reach"), goal("depth")))


@pytest.mark.parametrize(
    ("asked", "path", "bound"),
    [
        (goal("entry_angle", within_deg=0.5), "within_deg", "must be at least 1 deg"),
        (goal("entry_angle", within_deg=46), "within_deg", "must be at most 45 deg"),
        (goal("entry_angle", within_deg=5, angle_deg=91), "angle_deg", "must be at most 90 deg"),
        (goal("speed", at_most_mm_per_s=0.1), "at_most_mm_per_s", "must be at least 0.5 mm/s"),
        (goal("speed", at_most_mm_per_s=2000), "at_most_mm_per_s", "must be at most 1000 mm/s"),
    ],
)
def test_a_bound_is_told_with_its_unit(write, asked, path, bound):
    with pytest.raises(ConfigurationError) as error:
        load_exercise(write(goal("reach"), asked))
    assert [(p.path, p.reason) for p in error.value.problems] == [(f"goal[1].{path}", bound)]

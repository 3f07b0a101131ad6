"""Compares metrics with values calculated by hand, for a needle that moves without lag."""

import math

import numpy as np
import punctura as pn
import pytest
from attempts import HEAD, goal, ideal, judged, of_positions
from punctura._core import Limit
from punctura.exercise import load_exercise
from punctura.exercise.quantities import tenths
from punctura.simulation import Hand

SCENE = pn.load_scene("venipuncture")  # the skin at 0, 1.2 mm thick; walls at -4.81 and -8.22, 0.4 mm thick
TIP = 0.8e-3 / math.tan(math.radians(11))  # m
TICK = 1 / SCENE.servo.rate
STEP = 10e-3 * TICK  # m that the needle moves in a tick
NEVER = goal("stay", seconds=1000)  # so that nothing is decided


def measured(write, columns, *goals):
    return judged(load_exercise(write(*goals)), columns, scene=SCENE).finish()


def test_times_and_stays(write):
    columns = ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=2)
    result = measured(write, columns, goal("reach"), goal("stay", seconds=1))
    m = result.metrics
    assert result.passed
    assert m.time_to_target == pytest.approx(0.521, abs=2 * TICK)  # 4.81 + 0.4 mm at 10 mm/s
    assert m.total_time == pytest.approx(1.521, abs=3 * TICK)
    assert m.dwell == m.longest_stay == pytest.approx(1.0, abs=3 * TICK)
    assert result.reasons == [
        "You reached the vein 0.5 s after touching the skin, at the first entry.",
        "You stayed in it for 1.0 s.",
    ]


def test_the_dwell_is_the_sum_of_all_stays(write):
    up_and_down = [(0, 5, 0), (0, -6, 0), (0, -5, 0), (0, -7, 0), (0, -5, 0)]
    m = measured(write, ideal(SCENE, *up_and_down), NEVER).metrics
    # The vein begins at 5.21 mm: 2 x 0.79 and 2 x 1.79 mm at 10 mm/s.
    assert m.dwell == pytest.approx(0.158 + 0.358, abs=8 * TICK)
    assert m.longest_stay == pytest.approx(0.358, abs=4 * TICK)


def test_the_vein_ends_where_the_back_wall_begins(write):
    m = measured(write, ideal(SCENE, (0, 5, 0), (0, -8.5, 0)), NEVER).metrics
    assert m.dwell == pytest.approx(0.301, abs=4 * TICK)  # 3.01 mm


def test_overshoot_is_what_the_tip_runs_on_in_300_ms(write):
    m = measured(write, ideal(SCENE, (0, 5, 0), (0, -14, 0), stops=1), NEVER).metrics
    assert [one.name for one in m.overshoot] == ["skin", "front vein wall", "back vein wall"]
    skin, front, back = m.overshoot
    assert skin.time == pytest.approx(0.5 + (1.2e-3 + TIP) / 10e-3, abs=2 * TICK)
    assert [skin.distance, front.distance] == pytest.approx([3e-3, 3e-3], abs=2 * STEP)
    assert back.distance == pytest.approx(14e-3 - 8.62e-3 - TIP, abs=2 * STEP)  # it stops before 0.3 s are over


def test_what_comes_later_is_no_overshoot(write):
    first = 1.2 + TIP * 1e3 + 0.5
    columns = ideal(SCENE, (0, 5, 0), (0, -first, 0), stops=0.5)
    later = ideal(SCENE, (0, -first, 0), (0, -7, 0))
    position = np.concatenate([columns["tip"], later["tip"]])
    m = measured(write, of_positions(SCENE, position), NEVER).metrics
    assert m.overshoot[0].distance == pytest.approx(0.5e-3, abs=2 * STEP)


def test_the_peak_force_is_that_of_all_membranes_together(write):
    columns = ideal(SCENE, (0, 5, 0), (0, -14, 0))
    depth = np.linspace(0, 14e-3, 140_001)
    laws = [pn.ThickLaw(SCENE.needle, placed.membrane) for placed in SCENE.membranes]
    total = sum(-law.bounds(depth + placed.point[1])[0] for law, placed in zip(laws, SCENE.membranes, strict=True))
    m = measured(write, columns, NEVER).metrics
    assert m.peak_force == pytest.approx(total.max(), rel=1e-3)
    assert m.peak_force > 1.1 * 0.446  # of the skin alone


def test_a_straight_path_is_straight(write):
    m = measured(write, ideal(SCENE, (0, 5, 0), (3, -6, 0)), NEVER).metrics
    way = 5.21 / 11 * math.hypot(3, 11) * 1e-3  # from the skin to the vein
    assert m.net_distance == pytest.approx(way, abs=2 * STEP)
    assert m.path_length == pytest.approx(way, abs=2 * STEP)
    assert m.straightness == pytest.approx(1, abs=1e-9)
    assert m.lateral_deviation == pytest.approx(3 / 11 * 6e-3, abs=2 * STEP)  # the needle points straight in


def test_a_detour_makes_the_path_longer(write):
    m = measured(write, ideal(SCENE, (0, 5, 0), (0, -3, 0), (2, -3, 0), (2, -6, 0)), NEVER).metrics
    cut = 2 * (2 - math.sqrt(2)) * 0.5e-3  # what a ruler of 0.5 mm cuts off two corners at most
    assert 7.21e-3 - cut - 3 * STEP <= m.path_length <= 7.21e-3
    assert m.net_distance == pytest.approx(math.hypot(5.21e-3, 2e-3), abs=2 * STEP)
    assert m.straightness == m.path_length / m.net_distance > 1.15
    assert m.lateral_deviation == pytest.approx(2e-3, abs=STEP)


def test_a_path_that_misses_ends_at_its_deepest_point(write):
    m = measured(write, ideal(SCENE, (0, 5, 0), (0, -4, 0), (3, 1, 0)), NEVER).metrics
    assert m.path_length == m.net_distance == pytest.approx(4e-3, abs=2 * STEP)
    assert (m.time_to_target, m.lateral_deviation) == (None, pytest.approx(2.4e-3, abs=2 * STEP))  # as it comes out


def test_a_hand_that_trembles_goes_no_longer_way(write):
    columns = ideal(SCENE, (0, 5, 0), (0, -4.5, 0), stops=5)
    random = np.random.default_rng(1)
    t = columns["time"]
    phases = random.uniform(0, 6, (3, 1, 3))
    tremor = sum(
        2.4e-5 * np.sin(2 * np.pi * hertz * t[:, None] + phase) for hertz, phase in zip((8, 9, 11), phases, strict=True)
    )
    assert tremor.std() == pytest.approx(Hand().tremor_rms, rel=0.05)
    m = measured(write, of_positions(SCENE, columns["tip"] + tremor), NEVER).metrics
    assert m.straightness == pytest.approx(1, abs=0.03)


def test_each_entry_is_an_attempt_and_the_path_begins_with_the_last(write):
    corners = [(0, 5, 0), (0, -2, 0), (0, 2, 0), (1, 2, 0), (1, -6, 0)]
    result = measured(write, ideal(SCENE, *corners), goal("reach"))
    m = result.metrics
    assert m.entries == 2
    # Down 2, up 2, up 2 outside, across 1, down 2 outside and 5.21: all at 10 mm/s.
    assert m.time_to_target == pytest.approx(1.421, abs=4 * TICK)
    assert m.path_length == pytest.approx(5.21e-3, abs=2 * STEP)
    assert m.lateral_deviation == pytest.approx(0, abs=1e-9)
    assert "with 2 entries" in result.reasons[0]


def test_the_angle_of_entry_is_that_to_the_skin(write):
    columns = ideal(SCENE, (0, 5, 0), (0, -2, 0))
    slanted = np.array([math.cos(0.6), -math.sin(0.6), 0])
    columns["direction"] = np.tile(slanted, (*columns["depth"].shape, 1))
    assert measured(write, columns, NEVER).metrics.entry_angle == pytest.approx(0.6)
    del columns["direction"]
    columns["axis"] = np.tile(2 * slanted, (len(columns["tick"]), 1))
    assert measured(write, columns, NEVER).metrics.entry_angle == pytest.approx(0.6)


def test_ticks_that_never_came_are_reported(write):
    columns = ideal(SCENE, (0, 5, 0), (0, -2, 0))
    keep = np.ones(len(columns["tick"]), dtype=bool)
    keep[500:523] = False
    m = measured(write, {name: column[keep] for name, column in columns.items()}, NEVER).metrics
    assert m.lost_ticks == 23


def test_a_limit_that_cut_the_force_is_told_with_its_time(write):
    columns = ideal(SCENE, (0, 5, 0), (0, -6, 0))
    columns["limit"] = np.zeros(len(columns["tick"]), np.uint8)
    columns["limit"][-800:] = Limit.continuous.value
    columns["limit"][:400] = Limit.ramp.value  # a force that grows after arming is no news
    result = measured(write, columns, NEVER)
    assert result.metrics.force_cut == {"long-run limit": pytest.approx(800 / SCENE.servo.rate)}
    assert result.reasons[-1] == "Limits cut the felt force for 0.5 s (long-run limit)."


def test_nothing_at_all_gives_a_result_without_metrics(write):
    exercise = load_exercise(write(NEVER))
    m = judged(exercise, ideal(SCENE, (0, 5, 0), (0, 4, 0)), scene=SCENE).finish().metrics
    assert m.model_dump() == {
        "entries": 0, "peak_force": 0, "peak_felt_force": 0, "force_scale": 1, "losses": [], "yields": [],
        "overshoot": [], "dwell": 0, "longest_stay": 0, "path_length": None, "net_distance": None, "straightness": None,
        "lateral_deviation": None, "entry_angle": None,
        "time_to_target": None, "total_time": 0, "lost_ticks": 0, "force_cut": {}, "force_off": 0, "page_late": 0,
        "computer_late": 0,
    }  # fmt: skip


def test_sentences_and_measures_have_the_same_numbers(write):
    """The goal counts the whole tip, so the table does; before, it counted the point: 3 s against 9.5."""
    head = HEAD.replace("[space]", "[space]\npress_mm = 9")
    down = ideal(SCENE, (0, 5, 0), (0, -7, 0), stops=6)["tip"]  # the point alone, for 6 s
    position = np.concatenate([down, ideal(SCENE, (0, -7, 0), (0, -10, 0), stops=4)["tip"]])
    goals = goal("reach"), goal("stay", seconds=2.25, whole_tip=True)
    result = judged(load_exercise(write(*goals, head=head)), of_positions(SCENE, position), scene=SCENE).finish()
    m = result.metrics
    assert m.longest_stay == m.dwell == pytest.approx(2.25, abs=TICK)
    assert result.reasons[-1] == f"You stayed in it for {tenths(m.longest_stay)} s."
    assert m.time_to_target == pytest.approx(0.521, abs=2 * TICK)  # of the point, as the reach goal wants it


def test_the_arrival_is_that_of_the_reach_goal(write):
    head = HEAD.replace("[space]", "[space]\npress_mm = 9")
    columns = ideal(SCENE, (0, 5, 0), (0, -10, 0), stops=1)
    exercise = load_exercise(write(goal("reach", whole_tip=True), goal("stay", seconds=9), head=head))
    m = judged(exercise, columns, scene=SCENE).finish().metrics
    assert m.time_to_target == pytest.approx(0.521 + TIP / 10e-3, abs=2 * TICK)


def test_an_overshoot_is_measured_in_the_time_that_its_goal_says(write):
    stop = goal("stop_after_pop", membrane="skin", within_mm=9, seconds=0.5)
    m = measured(write, ideal(SCENE, (0, 5, 0), (0, -14, 0)), NEVER, stop).metrics
    skin, front = m.overshoot[:2]
    assert (skin.seconds, front.seconds) == (0.5, 0.3)
    assert [skin.distance, front.distance] == pytest.approx([5e-3, 3e-3], abs=2 * STEP)


@pytest.mark.parametrize(("value", "text"), [(0.25, "0.3"), (2.25, "2.3"), (0.35, "0.3"), (3.04999, "3.0"), (0, "0.0")])
def test_a_tenth_is_rounded_as_the_page_rounds(value, text):
    """JavaScript's toFixed: the nearest, and of two that are as near the larger."""
    assert tenths(value) == text


LINE = {"point_mm": [0, -6.7, 0], "along": [1, 0, 0], "within_mm": 1.0}


@pytest.mark.parametrize(("z", "state"), [(0.0, "met"), (0.9, "met"), (-1.5, "missed")])
def test_a_line_is_met_by_a_point_that_is_near_it_while_it_is_in_the_space(write, z, state):
    columns = ideal(SCENE, (0, 5, -4), (0, 2, z), (3, -6, z), stops=1)  # in front of the skin it may be anywhere
    result = measured(write, columns, goal("on_line", **LINE), goal("stay", seconds=0.5))
    assert result.goals[0].state == state
    assert result.goals[0].text == "Keep the point within 1 mm of the middle line"
    about = [
        remark.numbers["beside_m"]
        for remark in [*result.coaching.good, *result.coaching.change]
        if remark.about == "line"
    ]
    assert about == [pytest.approx(abs(z) * 1e-3, abs=1e-9)]
    if state == "missed":
        assert result.reasons == ["The point came into the vein 1.5 mm beside the middle line."]

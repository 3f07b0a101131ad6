"""Readings that are late or missing: what they cannot have changed is measured, and nothing else is told."""

import numpy as np
import punctura as pn
import pytest
from attempts import HEAD, goal, ideal, judged, late, of_positions, without
from punctura.exercise import load_exercise
from punctura.exercise.quantities import mm, tenths

SCENE = pn.load_scene("venipuncture")  # the skin at 0, 1.2 mm thick; walls at -4.81 and -8.22, 0.4 mm thick
RATE = SCENE.servo.rate
TIP = SCENE.needle.diameter / np.tan(SCENE.needle.tip_angle) * 1e3  # mm, 4.12
TOUCH, SPACE = 800, 800 + round(0.521 * RATE)  # ticks: 5 mm at 10 mm/s; and 5.21 mm more
CUTS = pytest.mark.parametrize("cuts", [29, 100_000])
PRESS = HEAD.replace("[space]", "[space]\npress_mm = 9")
DOWN = ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=5)
STAY = goal("stay", seconds=2)
LIMITS = {
    "never_pass": goal("never_pass", membrane="back vein wall"),
    "peak_force": goal("peak_force", at_most_N=9.0),
    "entries": goal("entries", at_most=3),
    "straight": goal("straight", within_mm=3),
    "speed": goal("speed", at_most_mm_per_s=30),
    "no_pause": goal("no_pause", seconds=1),
    "depth": goal("depth", at_most_mm=2),
    "time_limit": goal("time_limit", seconds=9),
    "on_line": goal("on_line", point_mm=[0, -6.7, 0], along=[1, 0, 0], within_mm=1),
}


def result(write, columns, *goals, cuts=160, head=PRESS, simulated=False):
    return judged(load_exercise(write(*goals, head=head)), columns, cuts, SCENE, simulated=simulated).finish()


def abouts(remarks):
    return {remark.about for remark in remarks}


@CUTS
def test_late_ticks_of_a_simulated_device_hide_nothing_because_its_needle_moves_in_ticks_only(write, cuts):
    busy = late(DOWN, (300, 0.9), (1000, 0.05), (1400, 0.03), (SPACE + 50, 0.15), (SPACE + 2000, 0.1))
    made = result(write, busy, STAY, *LIMITS.values(), cuts=cuts, simulated=True)
    assert made.passed, made.reasons
    steady = result(write, busy, STAY, LIMITS["no_pause"], cuts=cuts, simulated=True)
    assert "pauses" in abouts(steady.coaching.good)
    assert made.metrics.computer_late == pytest.approx(0.33, abs=1e-9)
    held = next(remark.numbers["held_s"] for remark in made.coaching.good if remark.about == "tremor")
    assert held == made.metrics.longest_stay == pytest.approx(2, abs=2 / RATE)  # not the 2.25 s of the clock
    device = result(write, busy, STAY, *LIMITS.values(), cuts=cuts)  # it has moved meanwhile
    assert not device.passed and len(device.unmeasured) > 3


@CUTS
def test_what_a_late_computer_adds_to_a_standstill_is_nobodys(write, cuts):
    parts = ideal(SCENE, (0, 5, 0), (0, -3, 0), stops=0.8)["tip"], ideal(SCENE, (0, -3, 0), (0, -6, 0), stops=3)["tip"]
    stands = of_positions(SCENE, np.concatenate(parts))
    pause = LIMITS["no_pause"]
    assert result(write, stands, STAY, pause, cuts=cuts).passed
    busy = late(stands, (1600, 0.7))
    made = result(write, busy, STAY, pause, cuts=cuts, simulated=True)
    assert made.passed and "pauses" not in abouts([*made.coaching.good, *made.coaching.change])
    assert made.reasons[-1].startswith("The computer was late: for 0.7 s together it computed nothing")
    longer = goal("no_pause", seconds=0.6)  # with the lateness nobody knows whether the hand would have gone on
    made = result(write, busy, STAY, longer, cuts=cuts, simulated=True)
    assert made.withheld == "not everything was measured" and "Readings were late" in " ".join(made.reasons)
    assert "pauses" not in abouts([*made.coaching.good, *made.coaching.change])


@CUTS
def test_a_stop_is_measured_for_all_of_its_time(write, cuts):
    """The wall lets the needle go in the 0.3 s after the pop; a late computer lets it go on only later."""
    stop = goal("stop_after_pop", membrane="skin", within_mm=1)
    jump = ideal(SCENE, (0, 5, 0), (0, -1.2 - TIP - 1.5, 0), stops=1)
    popped = round((5 + 1.2 + TIP) / 10e-3 * 1e-3 * RATE) + 2
    busy = late(jump, (popped + 40, 0.25))
    made = result(write, busy, goal("reach"), stop, cuts=cuts, simulated=True)
    assert [one.state for one in made.goals] == ["met", "not measured"]
    at_once = late(jump, (popped + 300, 0.25))
    made = result(write, at_once, goal("reach"), stop, cuts=cuts, simulated=True)
    assert made.goals[1].state == "missed" and made.metrics.overshoot[0].distance > 1e-3


@CUTS
def test_the_time_that_a_late_computer_took_decides_no_time_limit(write, cuts):
    limit = goal("time_limit", seconds=3)
    made = result(write, late(DOWN, (SPACE + 100, 0.6)), STAY, limit, cuts=cuts, simulated=True)
    assert made.goals[1].state == "not measured" and made.metrics.total_time > 3
    assert result(write, late(DOWN, (SPACE + 100, 0.3)), STAY, limit, cuts=cuts, simulated=True).passed


@CUTS
@pytest.mark.parametrize("kind", LIMITS)
def test_missing_readings_before_the_first_contact_are_no_matter(write, kind, cuts):
    made = result(write, without(DOWN, 100, 700), STAY, LIMITS[kind], cuts=cuts)
    assert made.passed, made.reasons


@CUTS
@pytest.mark.parametrize("kind", LIMITS)
def test_missing_readings_matter_only_where_the_goal_could_have_changed(write, kind, cuts):
    """100 ms in the tissue before the vein, and in the vein: too short to go somewhere and to come back."""
    matters = {
        "way": {"peak_force", "straight", "speed", "no_pause"},
        "vein": {"peak_force", "straight", "speed", "depth", "on_line"},
    }
    for place, tick in (("way", TOUCH + 300), ("vein", SPACE + 300)):
        made = result(write, without(DOWN, tick, tick + 160), STAY, LIMITS[kind], cuts=cuts)
        assert made.goals[1].state == ("not measured" if kind in matters[place] else "met"), place


@CUTS
def test_a_stop_after_a_pop_needs_the_readings_until_its_time_is_over(write, cuts):
    stop = goal("stop_after_pop", membrane="skin", within_mm=9)
    columns = ideal(SCENE, (0, 5, 0), (0, -1.2 - TIP - 1.5, 0), stops=3)
    popped = round((5 + 1.2 + TIP) / 10e-3 * 1e-3 * RATE)
    states = [
        result(write, without(columns, tick, tick + 160), STAY, stop, cuts=cuts).goals[1].state
        for tick in (popped - 200, popped + 100, popped + 600)
    ]
    assert states == ["not measured", "not measured", "met"]


@CUTS
def test_missing_readings_for_longer_than_a_hand_needs_to_go_and_come_back_matter_to_each_limit(write, cuts):
    gone = without(DOWN, SPACE + 300, SPACE + 300 + round(0.3 * RATE))
    made = result(write, gone, STAY, LIMITS["entries"], LIMITS["never_pass"], cuts=cuts)
    assert [one.state for one in made.goals[1:]] == ["not measured", "not measured"]


@CUTS
def test_nobody_is_praised_for_what_was_not_measured(write, cuts):
    gone = without(DOWN, TOUCH + 300, TOUCH + 460)
    for limit in (LIMITS["entries"], LIMITS["no_pause"], LIMITS["straight"]):
        assert not abouts(result(write, gone, STAY, limit, cuts=cuts).coaching.good) & {"pauses", "aside"}


@CUTS
def test_all_that_is_told_of_one_stay_has_the_same_number(write, cuts):
    """It was 2.0 s in the list and 5.3 s in the coach's praise, because missing readings had ended the stay."""
    columns = without(ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=5), SPACE + 4800, SPACE + 4900)
    made = result(write, columns, goal("stay", seconds=4), cuts=cuts)
    told = tenths(made.metrics.longest_stay)
    assert told == "3.0"
    reason = f"You stayed in the vein for {told} s; the goal is 4 s. Readings were missing at "
    assert made.reasons[0].startswith(reason)
    assert next(one.text for one in made.coaching.good if one.about == "tremor").startswith(
        f"You held still: in {told} s"
    )
    assert "left" not in abouts(made.coaching.change)  # the needle left nothing


@CUTS
def test_all_that_is_told_of_one_way_to_the_side_has_the_same_number(write, cuts):
    columns = ideal(SCENE, (0, 5, 0), (0, -6, 0), (0, -6, 2.0), stops=1)
    made = result(write, columns, goal("stay", seconds=9), goal("straight", within_mm=1.5), cuts=cuts)
    assert made.goals[1].state == "missed"
    assert made.metrics.lateral_deviation >= 1.5e-3 and mm(made.metrics.lateral_deviation) == "1.5 mm"

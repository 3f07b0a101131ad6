"""A limit is called met only after it was measured: open windows are waited for, and what was not measured says so."""

import numpy as np
import punctura as pn
import pytest
from attempts import HEAD, goal, ideal, judged, of_positions, without
from punctura.exercise import Attempt, load_exercise
from runs import cut

SCENE = pn.load_scene("venipuncture")  # the skin at 0, 1.2 mm thick; walls at -4.81 and -8.22, 0.4 mm thick
TIP = SCENE.needle.diameter / np.tan(SCENE.needle.tip_angle) * 1e3  # mm, 4.12
CUTS = [29, 100_000]
PRESS = HEAD.replace("[space]", "[space]\npress_mm = 9")
STOP = goal("stop_after_pop", membrane="front vein wall", within_mm=1.0)


def attempt(write, columns, *goals, cuts=160, head=PRESS):
    return judged(load_exercise(write(*goals, head=head)), columns, cuts, SCENE)


def states(made):
    return [g.state for g in made.finish().goals]


@pytest.mark.parametrize("cuts", CUTS)
def test_reaching_the_space_is_no_success_while_the_pop_and_its_overshoot_are_still_to_come(write, cuts):
    """The point reaches the vein 4.1 mm before the whole tip pops; then the needle runs on by 5.6 mm."""
    columns = ideal(SCENE, (0, 5, 0), (0, -5.21 - TIP - 5.6, 0), speed=40e-3, stops=1)
    made = attempt(write, columns, goal("reach"), STOP, cuts=cuts)
    result = made.finish()
    assert made.over and not result.passed
    assert [g.state for g in result.goals] == ["met", "missed"]
    assert result.reasons[0].startswith("You ran more than 1 mm past the front vein wall")
    front = next(one for one in result.metrics.overshoot if one.name == "front vein wall")
    assert front.distance == pytest.approx(5.6e-3, abs=5e-5)  # all of it, not only up to the decision


@pytest.mark.parametrize("cuts", CUTS)
def test_success_comes_when_the_window_after_the_pop_is_over(write, cuts):
    columns = ideal(SCENE, (0, 5, 0), (0, -10, 0), stops=1)
    made = attempt(write, columns, goal("reach"), STOP, cuts=cuts)
    result = made.finish()
    assert result.passed and [g.state for g in result.goals] == ["met", "met"]
    pop = next(e for e in result.events if e.what == "pop" and e.name == "front vein wall")
    assert result.metrics.total_time == pytest.approx(pop.time - 0.5 + 0.3, abs=2e-3)


def test_a_limit_on_the_skin_is_waited_for_too(write):
    """The vein is reached before the skin has let go."""
    stop = goal("stop_after_pop", membrane="skin", within_mm=1.0)
    assert not attempt(write, ideal(SCENE, (0, 5, 0), (0, -8, 0), stops=1), goal("reach"), stop).finish().passed
    assert attempt(write, ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=1), goal("reach"), stop).finish().passed


def test_whoever_waits_for_a_pop_is_told_to_go_on(write):
    made = attempt(write, ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=1), goal("reach"), STOP)
    assert not made.over and [g.state for g in made.goals] == ["met", "open"]
    assert made.status.instruction.startswith("Go on until the front vein wall gives way")
    popped = attempt(write, ideal(SCENE, (0, 5, 0), (0, -10, 0), stops=0.1), goal("reach"), STOP)
    assert not popped.over and popped.status.instruction == "Hold still."


def test_a_pop_that_never_came_is_not_called_met(write):
    made = attempt(write, ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=1), goal("reach"), STOP)
    result = made.finish()
    assert not result.passed and states(made) == ["met", "not measured"]
    assert "because the front vein wall never gave way" in result.reasons[-1]


def test_an_attempt_that_ends_within_the_window_is_not_passed(write):
    result = attempt(write, ideal(SCENE, (0, 5, 0), (0, -10, 0), stops=0.1), goal("reach"), STOP).finish()
    assert not result.passed and result.goals[1].state == "not measured"
    assert "ended within 0.3 s after the front vein wall gave way" in result.reasons[-1]


def test_a_membrane_that_was_never_entered_is_not_measured_and_that_is_no_pass(write):
    behind = goal("stop_after_pop", membrane="back vein wall", within_mm=1.0)
    result = attempt(write, ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=1), goal("reach"), behind, head=HEAD).finish()
    assert not result.passed and [g.state for g in result.goals] == ["met", "not measured"]
    assert result.verdict == "not judged as passed: not everything was measured" and len(result.unmeasured) == 1
    assert result.reasons[-1].startswith("Not measured: ") and "never gave way" in result.reasons[-1]


@pytest.mark.parametrize("cuts", CUTS)
def test_leaving_the_space_within_the_window_undoes_the_goal_until_the_needle_is_back(write, cuts):
    stop = goal("stop_after_pop", membrane="front vein wall", within_mm=9.0, seconds=1.0)
    reach = goal("reach", whole_tip=True)
    head = HEAD.replace("[space]", "[space]\npress_mm = 2")  # the space ends 10.22 mm deep
    out = ideal(SCENE, (0, 5, 0), (0, -10.4, 0), stops=2)
    made = attempt(write, out, reach, stop, cuts=cuts, head=head)
    assert not made.over and states(made) == ["open", "met"]
    assert made.finish().reasons == ["You left the vein before everything was measured."]
    back = np.concatenate([out["tip"], ideal(SCENE, (0, -10.4, 0), (0, -9.6, 0))["tip"]])
    again = attempt(write, of_positions(SCENE, back), reach, stop, cuts=cuts, head=head)
    assert again.over and again.finish().passed


@pytest.mark.parametrize("seed", range(3))
def test_waiting_does_not_depend_on_how_the_batches_are_cut(write, seed):
    random = np.random.default_rng(seed)
    corners = [(0, 5, 0), *[(0, float(y), 0) for y in random.uniform(-11, -4, 12)]]
    columns = ideal(SCENE, *corners, speed=20e-3)
    exercise = load_exercise(write(goal("stay", seconds=0.2), goal("reach"), STOP.replace("1.0", "2.5"), head=PRESS))
    whole = judged(exercise, columns, 10**6, SCENE).finish().model_dump(exclude={"date"})
    for places in (range(0, 10**6, 13), random.integers(0, len(columns["tick"]), 60)):
        made = Attempt(exercise, SCENE)
        for batch in cut(columns, places):
            made.add(batch)
        assert made.finish().model_dump(exclude={"date"}) == whole


LIMITS = {
    "never_pass": goal("never_pass", membrane="back vein wall"),
    "stop_after_pop": goal("stop_after_pop", membrane="skin", within_mm=9.0),
    "peak_force": goal("peak_force", at_most_N=9.0),
    "entries": goal("entries", at_most=3),
    "time_limit": goal("time_limit", seconds=60),
}


@pytest.mark.parametrize("cuts", CUTS)
@pytest.mark.parametrize("kind", LIMITS)
def test_a_limit_is_not_met_where_its_readings_were_missing(write, kind, cuts):
    columns = ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=1)
    goals = goal("stay", seconds=0.5), LIMITS[kind]
    assert states(attempt(write, columns, *goals, cuts=cuts)) == ["met", "met"]
    made = attempt(write, without(columns, 700, 1200), *goals, cuts=cuts)
    result = made.finish()
    if kind == "time_limit":  # the clock goes on, whatever comes
        assert states(made) == ["met", "met"]
        return
    assert not result.passed and states(made) == ["met", "not measured"]
    assert "Readings were late or missing" in result.reasons[-1] and "close them, and try again" in result.reasons[-1]
    few = attempt(write, without(columns, 700, 720), *goals, cuts=cuts)  # 12 ms: nothing happens unseen
    assert states(few) == ["met", "met"]


def test_missing_readings_are_told_once_for_all_goals(write):
    columns = without(ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=1), 700, 1200)
    result = attempt(write, columns, goal("stay", seconds=0.5), LIMITS["entries"], LIMITS["peak_force"]).finish()
    told = [reason for reason in result.reasons if "Readings were late or missing" in reason]
    assert len(told) == 1 and told[0].count("“") == 2


def test_a_force_that_is_no_number_is_not_a_small_one(write):
    columns = ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=1)
    columns["model_force"][700:1200] = np.nan
    result = attempt(write, columns, goal("stay", seconds=0.5), LIMITS["peak_force"]).finish()
    assert result.goals[1].state == "not measured"
    assert result.metrics.peak_force > 0.1


def test_a_depth_that_is_no_number_is_not_a_membrane_that_was_spared(write):
    head = HEAD.replace('in_front_of = "back vein wall"', "deepest_mm = 9")
    columns = ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=1)
    columns["depth"][:, 2] = np.nan
    result = attempt(write, columns, goal("stay", seconds=0.5), LIMITS["never_pass"], head=head).finish()
    assert result.goals[1].state == "not measured"


def test_time_without_a_touch_is_not_measured(write):
    """The scene's first membrane lies aside: the needle reaches the vein without touching it."""
    columns = ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=1)
    columns["depth"][:, 0] = -1e-3
    columns["phase"][:, 0] = 0
    result = attempt(write, columns, goal("stay", seconds=0.5), LIMITS["time_limit"]).finish()
    assert result.goals[1].state == "not measured"
    assert "no contact with the skin" in result.reasons[-1]


@pytest.mark.parametrize("cuts", CUTS)
def test_a_stay_is_not_counted_through_missing_readings(write, cuts):
    columns = ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=1.0)
    gone = without(columns, 1900, 2600)  # 0.44 s
    made = attempt(write, gone, goal("stay", seconds=0.6), cuts=cuts)
    assert not made.over
    m = made.finish().metrics
    assert m.longest_stay < 0.5 and m.dwell == pytest.approx(1.08 - 0.4375, abs=5e-3)

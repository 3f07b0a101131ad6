"""The score of an attempt does not depend on how its ticks are split into batches, nor on invalid values in them."""

import time

import numpy as np
import punctura as pn
import pytest
from attempts import as_a_device_runs_it, goal, hand_run, ideal, judged, motion_of, of_positions
from oracles import cases
from punctura._core import Fault, Phase, ServoLoop, SimulatedDevice
from punctura.exercise import Attempt, Result, load_exercise, score
from punctura.record import Recorder, open_recording
from runs import cut

SCENE = pn.load_scene("venipuncture")
WAIT = (1.0, 0.0)
RUNS = {
    "passed": ("venipuncture", (WAIT, (2.5, 20.0), (4.0, 27.8), (5.0, 27.8))),
    "through": ("venipuncture", (WAIT, (2.5, 20.0), (2.0, 33.0), (3.0, 33.0))),
    "ran on": ("epidural", (WAIT, (6.0, 47.0), (1.5, 67.0), (2.0, 67.0))),
    "gave up": ("epidural", (WAIT, (2.0, 30.0), (1.0, 30.0), (2.0, 0.0), (2.0, 20.0))),
}


def plain(result: Result):
    return {k: v for k, v in result.model_dump().items() if k not in ("date", "name", "recording")}


@pytest.mark.parametrize("run", RUNS)
def test_a_result_is_the_same_however_the_batches_are_cut(run):
    name, legs = RUNS[run]
    exercise, columns = load_exercise(name), hand_run(name, legs)
    n = len(columns["tick"])
    whole = plain(judged(exercise, columns, cuts=n).finish())
    random = np.random.default_rng(5)
    for _ in range(max(1, cases.count(8))):
        attempt = Attempt(exercise, as_a_device_runs_it(exercise.scene))
        for batch in cut(columns, random.integers(0, n, random.integers(1, 200))):
            attempt.add(batch)
        assert plain(attempt.finish()) == whole
    near = [event["tick"] for event in whole["events"]][-3:]
    attempt = Attempt(exercise, as_a_device_runs_it(exercise.scene))
    for batch in cut(columns, [tick + k for tick in near for k in range(-20, 20)]):
        attempt.add(batch)
    assert plain(attempt.finish()) == whole


@pytest.mark.parametrize("run", ["passed", "ran on"])
def test_a_result_is_the_same_live_and_from_the_recording(tmp_path, run):
    name, legs = RUNS[run]
    exercise = load_exercise(name)
    axis = np.asarray(exercise.start_axis)
    ticks = round(sum(seconds for seconds, _ in legs) * 1600)
    device = SimulatedDevice(motion_of(exercise, list(legs), axis), real_time=False, ticks=ticks, axis=axis)
    loop = ServoLoop(device, as_a_device_runs_it(exercise.scene))
    listener = loop.listen(ticks)
    recorder = Recorder(loop, tmp_path / "run.parquet", ticks)
    attempt = Attempt(exercise, loop.scene)
    loop.arm()
    loop.start()
    while not device.finished:
        time.sleep(1e-3)
        attempt.add(listener.read(100))
    loop.stop()
    recorder.finish()
    while len((columns := listener.read(100))["tick"]):
        attempt.add(columns)
    assert listener.lost == 0
    assert attempt.over
    live = attempt.finish("Ada", "run")
    again = score(tmp_path / "run.parquet", exercise, "Ada")
    assert plain(again) == plain(live)
    assert (again.recording, live.passed) == ("run", run == "passed")
    assert again.date.startswith(open_recording(tmp_path / "run.parquet").info.data["began"][:16])


def test_nothing_after_the_decision_counts(write):
    exercise = load_exercise(write(goal("reach"), goal("never_pass", membrane="back vein wall")))
    columns = ideal(SCENE, (0, 5, 0), (0, -14, 0), (0, 5, 0))
    attempt = judged(exercise, columns, scene=SCENE)
    result = attempt.finish()
    assert attempt.over and result.passed
    assert [state.state for state in result.goals] == ["met", "met"]
    assert result.events[-1].time <= result.metrics.time_to_target + 0.501
    attempt.add(columns)
    assert plain(attempt.finish()) == plain(result)


def test_a_limit_that_breaks_in_the_very_tick_of_success_is_missed(write):
    reach_all = goal("reach"), goal("peak_force", at_most_N=1e-3)
    assert (
        not judged(load_exercise(write(*reach_all)), ideal(SCENE, (0, 5, 0), (0, -7, 0)), scene=SCENE).finish().passed
    )


def test_too_much_force(write):
    exercise = load_exercise(write(goal("reach"), goal("peak_force", at_most_N=0.4)))
    result = judged(exercise, ideal(SCENE, (0, 5, 0), (0, -7, 0)), scene=SCENE).finish()
    assert not result.passed
    assert result.reasons == ["You pushed with more than 0.4 N."]
    assert result.metrics.peak_force == pytest.approx(0.4, abs=0.01)


@pytest.mark.parametrize(("within", "missed"), [(0.6, True), (0.8, False)])
def test_stopping_after_a_pop_is_judged_to_the_tenth_of_a_millimetre(write, within, missed):
    exercise = load_exercise(write(goal("stay", seconds=1), goal("stop_after_pop", membrane="skin", within_mm=within)))
    columns = ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=2)  # 0.68 mm past the pop
    result = judged(exercise, columns, scene=SCENE).finish()
    assert result.passed is not missed
    if missed:
        assert "more than 0.6 mm past the skin" in result.reasons[0]


@pytest.mark.parametrize("cuts", [27, 100_000])
def test_each_pop_of_a_membrane_is_judged(write, cuts):
    goals = goal("stay", seconds=9), goal("stop_after_pop", membrane="skin", within_mm=1.0)
    gently = ideal(SCENE, (0, 5, 0), (0, -5.6, 0), stops=0.5)["tip"]  # 0.3 mm past the pop, and back
    again = ideal(SCENE, (0, -5.6, 0), (0, -3, 0), (0, -7, 0))["tip"]
    result = judged(load_exercise(write(*goals)), of_positions(SCENE, np.concatenate([gently, again])), cuts, SCENE)
    assert result.over
    assert [e.time for e in result.finish().events if e.what == "pop"] == pytest.approx([1.032, 2.052], abs=2e-3)
    assert "past the skin" in result.finish().reasons[0]


def test_goals_in_ones_own_words(write):
    exercise = load_exercise(write(goal("reach", text="Into it"), goal("entries", at_most=1)))
    attempt = judged(exercise, ideal(SCENE, (0, 5, 0), (0, 4, 0)), scene=SCENE)
    assert [g.text for g in attempt.goals] == ["Into it", "Enter the skin no more than once"]


def test_an_attempt_that_begins_inside_begins_when_the_needle_is_out(write):
    exercise = load_exercise(write(goal("reach"), goal("never_pass", membrane="back vein wall")))
    columns = ideal(SCENE, (0, -9, 0), (0, 5, 0), (0, -2, 0))
    columns["phase"][: int((columns["tip"][:, 1] > 0).argmax())] = Phase.barred.value
    attempt = judged(exercise, columns, scene=SCENE)
    assert not attempt.over  # behind the back wall at first: no fault of theirs
    assert attempt.finish().metrics.entries == 1


def test_a_way_around_through_barred_membranes_reaches_nothing(write):
    columns = ideal(SCENE, (0, 5, 0), (0, -6, 0), stops=1)
    columns["phase"][columns["depth"] > 0] = Phase.barred.value
    result = judged(load_exercise(write(goal("reach"))), columns, scene=SCENE).finish()
    assert not result.passed
    assert result.reasons == ["You did not touch the skin."]


def test_columns_without_numbers_do_no_harm():
    exercise = load_exercise("venipuncture")
    columns = hand_run(*RUNS["passed"])
    nothing = {**columns, "depth": np.full_like(columns["depth"], np.nan)}
    result = judged(exercise, nothing).finish()
    assert (result.passed, result.metrics.entries) == (False, 0)
    torn = {name: column.copy() for name, column in columns.items()}
    torn["depth"][4000:4050] = np.nan
    torn["model_force"][2000:2010] = np.nan
    torn["tip"][5000:5010] = np.nan
    result = judged(exercise, torn).finish()
    assert result.withheld == "not everything was measured"  # 31 ms without a depth
    Result.model_validate_json(result.model_dump_json())
    few = {**columns, **{k: columns[k][:, :1] for k in ("depth", "axial_force", "lower", "upper", "phase")}}
    assert judged(exercise, few).finish().passed is False


def test_a_fault_ends_the_attempt_and_is_reported(write):
    columns = ideal(SCENE, (0, 5, 0), (0, -6, 0))
    columns["fault"][1000:] = Fault.position_jump.value
    attempt = judged(load_exercise(write(goal("stay", seconds=9))), columns, scene=SCENE)
    assert attempt.over
    assert attempt.finish().reasons[0].startswith("The run stopped: ")


def test_another_scene_on_the_way_makes_it_not_count(write):
    columns = ideal(SCENE, (0, 5, 0), (0, -6, 0))
    columns["commands"][1000] = 8
    result = judged(load_exercise(write(goal("stay", seconds=9))), columns, scene=SCENE).finish()
    assert result.reasons == ["The scene was changed during the exercise, so this attempt does not count."]


def test_an_exercise_needs_its_membranes():
    with pytest.raises(pn.ConfigurationError, match="has no membrane 'front vein wall'"):
        Attempt(load_exercise("venipuncture"), pn.load_scene("epidural"))


def test_a_result_says_what_it_is_of():
    result = judged(load_exercise("venipuncture"), hand_run(*RUNS["passed"])).finish("Ada", "run-1")
    assert (result.exercise, result.title, result.scene) == ("venipuncture", "Venipuncture", "Venipuncture")
    assert (result.person, result.recording, result.name, result.format) == ("Ada", "run-1", "", 1)
    assert result.version and result.date.endswith("+00:00")
    assert Result.model_validate_json(result.model_dump_json()) == result


def test_the_status_has_the_clock_and_the_time_held(write):
    scene = pn.load_scene("venipuncture")
    exercise = load_exercise(
        write(goal("stay", seconds=3), goal("time_limit", seconds=20), goal("time_limit", seconds=9))
    )
    columns = ideal(scene, (0, 5, 0), (0, -6, 0), stops=1)
    status = judged(exercise, columns, scene=scene).status
    assert (status.hold, status.time_limit) == (3, 9)
    assert status.time == pytest.approx(1.6, abs=2e-3)  # 6 mm at 10 mm/s, and 1 s of rest
    assert status.held == pytest.approx(1.079, abs=2e-3)  # the vein begins at 5.21 mm
    out = ideal(scene, (0, 5, 0), (0, -6, 0), (0, -4, 0), stops=1)
    assert judged(exercise, out, scene=scene).status.held == 0
    plain = judged(load_exercise(write(goal("reach"))), columns, scene=scene).status
    assert (plain.hold, plain.held, plain.time_limit) == (0, 0, None)
    assert plain.time == pytest.approx(0.521, abs=2e-3)  # up to the decision

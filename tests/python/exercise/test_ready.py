"""Each success and each failure in the ready exercises, with a simulated hand that follows a mouse."""

import pytest
from attempts import hand_run, judged, tried
from punctura.exercise import Attempt, exercise_names, exercises, load_exercise

WAIT = (1.0, 0.0)
# mm along the needle from the start: the skin at 10, the front wall at 19.6, the back wall at 26.4.
INTO_THE_VEIN = (WAIT, (2.5, 20.0), (4.0, 27.8), (5.0, 27.8))
# The skin at 6, the flavum at 47.6 to 51, the dura at 56. The hand must go farther by what the forces hold it back.
INTO_THE_SPACE = (WAIT, (6.0, 47.0), (4.5, 58.3), (5.0, 58.3))


def states(result):
    return {goal.text.split(":")[0]: goal.state for goal in result.goals}


def reasons_of(result):
    return " ".join(result.reasons)


def test_they_can_be_read_and_the_easiest_comes_first():
    assert exercise_names() == [
        "steady-push", "stop-after-pop", "vein-15", "venipuncture", "vein-45", "rolling-vein", "epidural",
        "epidural-plunger", "blind",
    ]  # fmt: skip
    assert [exercise.title for exercise in exercises()][-2:] == ["Epidural with the plunger", "Blind"]
    assert not any(exercise.warnings for exercise in exercises())
    assert [exercise.name for exercise in exercises() if exercise.file.blind] == ["blind"]


@pytest.mark.parametrize(
    ("name", "legs", "reason"),
    [
        ("steady-push", ((2.0, 7.0), (1.0, 0.0), (2.0, 13.0)), "You entered more than 1 time."),
        ("stop-after-pop", ((1.0, 16.0), (1.0, 16.0)), "You ran more than 2.5 mm past the thin membrane"),
        ("vein-45", ((2.5, 13.0), (2.0, 24.0), (1.0, 24.0)), "You went through the back vein wall"),
        ("blind", ((2.0, 22.0), (1.0, 22.0)), "You ran more than 3 mm past the second membrane"),
    ],
)
def test_each_can_be_failed(name, legs, reason):
    result = tried(name, WAIT, *legs)
    assert not result.passed and reasons_of(result).startswith(reason), result.reasons


@pytest.mark.parametrize("seed", range(4))
def test_venipuncture_can_be_passed(seed):
    result = tried("venipuncture", *INTO_THE_VEIN, seed=seed)
    assert result.passed, result.reasons
    assert set(states(result).values()) == {"met"}
    assert [e.name for e in result.events if e.what == "pop"] == ["skin", "front vein wall"]
    assert "You reached the vein" in reasons_of(result) and "at the first entry" in reasons_of(result)
    assert "stayed in it for 3.0 s" in reasons_of(result)
    assert result.metrics.entries == 1
    assert 3.0 <= result.metrics.dwell < 8
    assert 0.5 < result.metrics.peak_force < 1.2
    assert result.metrics.straightness == pytest.approx(1.0, abs=0.01)
    assert result.metrics.entry_angle == pytest.approx(0.5236, abs=1e-4)


@pytest.mark.parametrize("seed", range(4))
def test_epidural_can_be_passed(seed):
    result = tried("epidural", *INTO_THE_SPACE, seed=seed)
    assert result.passed, result.reasons
    assert set(states(result).values()) == {"met"}
    assert "ligamentum flavum" in [e.name for e in result.events if e.what == "pop"]
    assert "dura" not in [e.name for e in result.events if e.what == "pop"]
    assert max(one.distance for one in result.metrics.overshoot if one.name == "ligamentum flavum") < 2.5e-3
    assert 11 < result.metrics.peak_force < 13 and result.metrics.peak_felt_force < 0.76  # what an Omni can hold


def test_through_the_back_wall():
    result = tried("venipuncture", *INTO_THE_VEIN[:2], (2.0, 33.0), (3.0, 33.0))
    assert not result.passed
    assert states(result)["Do not go through the back vein wall"] == "missed"
    assert reasons_of(result).startswith("You went through the back vein wall ")
    assert reasons_of(result).endswith(" s after the flash-back.")
    assert "back vein wall" not in [e.name for e in result.events if e.what == "pop"]  # the point is through, no more


def test_the_vein_is_never_reached():
    result = tried("venipuncture", WAIT, (2.0, 16.0), (2.0, 16.0))
    assert not result.passed
    assert reasons_of(result) == "You did not reach the vein."
    assert result.metrics.time_to_target is None
    assert set(states(result).values()) == {"open"}


def test_the_skin_is_never_touched():
    result = tried("venipuncture", WAIT, (1.0, 5.0))
    assert reasons_of(result) == "You did not touch the skin."
    assert (result.metrics.entries, result.metrics.total_time, result.events) == (0, 0.0, [])


def test_not_staying_in_the_vein():
    result = tried("venipuncture", *INTO_THE_VEIN[:3], (2.0, 27.8), (1.0, 0.0))
    assert not result.passed
    assert states(result)["Reach the vein"] == "met"
    assert "You stayed in the vein for " in reasons_of(result) and "the goal is 3 s" in reasons_of(result)


def test_with_the_point_alone_in_the_vein_the_hold_does_not_begin():
    result = tried("venipuncture", *INTO_THE_VEIN[:2], (1.5, 24.0), (5.0, 24.0))
    assert not result.passed
    assert reasons_of(result) == "The whole tip was never in the vein."
    assert result.metrics.dwell == result.metrics.longest_stay == 0  # of the whole tip, as the goal asks
    assert result.metrics.time_to_target is not None


def test_an_upright_needle_is_longer_than_the_vein_is_wide():
    result = tried("venipuncture", WAIT, (3.0, 9.0), (8.0, 16.0), (3.0, 16.0), upright=True)
    assert not result.passed
    assert states(result)["Bring the whole tip into the vein, and hold it there for 3 s"] != "met"


def test_too_many_entries():
    tries = [leg for _ in range(4) for leg in ((1.0, 14.0), (1.0, 0.0))]
    result = tried("venipuncture", WAIT, *tries)
    assert not result.passed
    assert result.metrics.entries == 4
    assert reasons_of(result) == "You entered more than 3 times."


@pytest.mark.parametrize(("name", "limit", "mm"), [("venipuncture", 60, 16.0), ("epidural", 120, 20.0)])
def test_the_time_is_over(name, limit, mm):
    columns = hand_run(name, (WAIT, (2.0, mm), (limit + 2.0, mm)))
    result = judged(load_exercise(name), columns, cuts=4000).finish()
    assert not result.passed
    assert reasons_of(result) == f"The time ran out {limit} s after the first contact."
    assert result.metrics.total_time == pytest.approx(limit, abs=0.01)


def test_running_on_when_the_flavum_gives_way():
    result = tried("epidural", WAIT, (6.0, 47.0), (1.5, 67.0), (2.0, 67.0))
    assert not result.passed
    assert reasons_of(result).startswith("You ran more than 2.5 mm past the ligamentum flavum when it gave way")
    assert "through the dura" not in reasons_of(result)


def test_through_the_dura():
    result = tried("epidural", *INTO_THE_SPACE[:3], (1.0, 58.3), (6.0, 76.0), (2.0, 76.0))
    assert not result.passed
    assert reasons_of(result).startswith("You went through the dura ")
    assert reasons_of(result).endswith(" s after the loss of resistance.")
    assert result.events[-1].name == "dura" and result.events[-1].what == "pop"


def test_the_epidural_space_is_never_reached():
    result = tried("epidural", WAIT, (6.0, 50.0), (2.0, 50.0))
    assert not result.passed
    assert "You did not reach the epidural space." in reasons_of(result)


def test_who_has_gone_too_far_may_draw_back():
    result = tried("venipuncture", *INTO_THE_VEIN[:2], (3.0, 29.3), (2.0, 29.3), (1.0, 25.0), (5.0, 25.0))
    assert result.passed, result.reasons
    assert result.metrics.entries == 1


def test_the_person_is_told_what_to_do_next():
    exercise = load_exercise("venipuncture")
    columns = hand_run("venipuncture", INTO_THE_VEIN)
    attempt = judged(exercise, {name: column[:100] for name, column in columns.items()})
    assert attempt.status.instruction == exercise.instruction
    heard = []
    attempt = judged(exercise, {name: column[:0] for name, column in columns.items()})
    for k in range(0, len(columns["tick"]), 100):
        attempt.add({name: column[k : k + 100] for name, column in columns.items()})
        if attempt.status.instruction not in heard:
            heard.append(attempt.status.instruction)
    assert heard[0] == exercise.instruction
    assert heard[1:4] == [
        "Reach the vein: wait for the flash-back.",
        "Bring the whole tip into the vein, and hold it there for 3 s.",
        "Bring the whole tip into the vein, and hold it there for 3 s. Hold still.",
    ]
    assert heard[4].startswith("You reached the vein")
    assert attempt.over
    deep = judged(exercise, hand_run("venipuncture", (*INTO_THE_VEIN[:2], (3.0, 29.3), (0.5, 29.3))))
    assert deep.status.instruction == "You press against the back vein wall: draw back a little."


def test_whoever_must_still_push_is_not_told_to_stay():
    columns = hand_run("stop-after-pop", ((6.0, 13.0), (4.0, 13.0)))
    exercise = load_exercise("stop-after-pop")
    attempt = judged(exercise, {name: column[:0] for name, column in columns.items()})
    heard = []
    for k in range(0, len(columns["tick"]), 20):
        attempt.add({name: column[k : k + 20] for name, column in columns.items()})
        if attempt.status.instruction not in heard:
            heard.append(attempt.status.instruction)
    assert heard[:2] == [exercise.instruction, "Hold the whole tip behind the membrane for 2 s. Hold still."]


def test_a_stay_of_the_whole_tip_says_so():
    """Else the point alone in the space counts for nothing, and no word says why."""
    stays = [
        state.text
        for exercise in exercises()
        for goal, state in zip(exercise.goals, Attempt(exercise, exercise.scene).goals, strict=True)
        if goal.kind == "stay" and goal.whole_tip
    ]
    assert "Hold the whole tip in the epidural space for 3 s" in stays  # without a text of its own
    assert all("he whole tip" in text for text in stays)

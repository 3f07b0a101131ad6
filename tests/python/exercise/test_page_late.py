"""A page that stalls is told, and neither blames the student nor lets him pass."""

import numpy as np
import punctura as pn
import pytest
from attempts import HEAD, goal, ideal, judged
from punctura.exercise import load_exercise

SCENE = pn.load_scene("venipuncture")
PRESS = HEAD.replace("[space]", "[space]\npress_mm = 9")
RATE = SCENE.servo.rate


def stalled(stands, *corners, stops=1.0, word=0.1):
    """A needle that stands still for so long at the second corner, because the page is silent.

    Else a word of the page comes every so many seconds. Returns the ticks, and those of a student who stands still.
    """
    parts = ideal(SCENE, *corners[:2], stops=stands), ideal(SCENE, *corners[1:], stops=stops)
    columns = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    n, first = len(columns["tick"]), len(parts[0]["tick"]) - round(stands * RATE)
    tick = np.arange(n)
    columns |= {"tick": tick, "time": tick / RATE}
    spoken = np.floor(columns["time"] / word) * word
    silent = (tick >= first) & (tick < len(parts[0]["tick"]))
    return columns | {"page_age": columns["time"] - np.where(silent, min(first / RATE, 1e9), spoken)}, columns


def result(write, columns, *goals, cuts=160):
    return judged(load_exercise(write(*goals, head=PRESS)), columns, cuts, SCENE).finish()


def abouts(made):
    return [remark.about for remark in made.coaching.change]


@pytest.mark.parametrize("cuts", [29, 100_000])
def test_a_stall_on_the_way_is_no_pause_of_the_student(write, cuts):
    late, still = stalled(3.1, (0, 5, 0), (0, -3, 0), (0, -7, 0))
    stay = goal("stay", seconds=0.5)
    judged_late = result(write, still, stay, cuts=cuts)
    assert "pauses" in abouts(judged_late) and "page" not in " ".join(judged_late.reasons)
    asked = stay, goal("no_pause", seconds=1)
    assert not result(write, still, *asked, cuts=cuts).passed
    made = result(write, late, stay, cuts=cuts)
    assert made.passed and "pauses" not in abouts(made)
    assert made.reasons[-1].startswith("The page was late: for 2.8 s it sent nothing")
    assert made.metrics.page_late == pytest.approx(2.8, abs=0.01)
    unknown = result(write, late, *asked, cuts=cuts)  # nobody knows whether the student would have stood still
    assert not unknown.passed and unknown.withheld == "not everything was measured"
    assert "because the page was late then" in " ".join(unknown.reasons)
    short, _ = stalled(0.8, (0, 5, 0), (0, -3, 0), (0, -7, 0))
    assert result(write, short, *asked, cuts=cuts).passed


@pytest.mark.parametrize("cuts", [29, 100_000])
def test_one_standstill_is_never_blamed_on_both(write, cuts):
    """The page is silent for 0.8 s, and speaks again while the needle still stands."""
    ticks, _ = stalled(2.5, (0, 5, 0), (0, -3, 0), (0, -7, 0))
    began = ticks["time"][(ticks["page_age"] > 0.3).argmax()] - 0.3
    again = ticks["time"] >= began + 0.8
    ticks["page_age"] = np.where(again, 0.0, ticks["page_age"])
    stay = goal("stay", seconds=0.5)
    made = result(write, ticks, stay, goal("no_pause", seconds=1), cuts=cuts)
    assert made.withheld == "not everything was measured" and "You stood still" not in " ".join(made.reasons)
    assert "pauses" not in abouts(result(write, ticks, stay, cuts=cuts))
    waits = goal("no_pause", seconds=2.4)  # 1.7 s of the page that speaks are no pause of so long
    assert result(write, ticks, stay, waits, cuts=cuts).passed


@pytest.mark.parametrize("cuts", [29, 100_000])
def test_a_stall_before_the_first_contact_is_not_told(write, cuts):
    late, _ = stalled(3.0, (0, 8, 0), (0, 5, 0), (0, -7, 0))
    made = result(write, late, goal("stay", seconds=0.5), cuts=cuts)
    assert made.passed and made.metrics.page_late == 0 and "page" not in " ".join(made.reasons)


@pytest.mark.parametrize("cuts", [29, 100_000])
def test_a_stall_in_the_space_is_no_stay(write, cuts):
    late, still = stalled(3.0, (0, 5, 0), (0, -7, 0), (0, -6.9, 0), stops=0.5)
    assert result(write, still, goal("stay", seconds=2), cuts=cuts).passed
    made = result(write, late, goal("stay", seconds=2), cuts=cuts)
    assert not made.passed and made.metrics.longest_stay < 1.2


@pytest.mark.parametrize("cuts", [29, 100_000])
def test_a_stall_after_the_pop_is_no_stop(write, cuts):
    """The whole tip is through the front wall at 9.33 mm."""
    stop = goal("stop_after_pop", membrane="front vein wall", within_mm=0.5)
    late, still = stalled(1.5, (0, 5, 0), (0, -9.4, 0), (0, -11, 0))
    assert result(write, still, goal("reach"), stop, cuts=cuts).passed
    made = result(write, late, goal("reach"), stop, cuts=cuts)
    assert not made.passed and made.withheld == "not everything was measured"
    assert "because the page was late then" in " ".join(made.reasons)
    short, _ = stalled(0.5, (0, 5, 0), (0, -9.4, 0), (0, -9.5, 0))  # a slow computer
    assert result(write, short, goal("reach"), stop, cuts=cuts).passed

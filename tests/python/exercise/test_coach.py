"""Each sentence of the coach: for a trace of which it must be said, and for one of which it must not."""

import numpy as np
import punctura as pn
import pytest
from attempts import HEAD, goal, ideal, judged, of_positions
from punctura.exercise import load_exercise

SCENE = pn.load_scene("venipuncture")  # the skin at 0, 1.2 mm thick; walls at -4.81 and -8.22, 0.4 mm thick
RATE = SCENE.servo.rate
SKIN_POPS = 1.2 + 0.8 / np.tan(np.radians(11))  # mm deep
REACH, STAY = goal("reach"), goal("stay", seconds=2)
DEEP = HEAD.replace("[space]", "[space]\npress_mm = 9")


def way(*legs):
    """Straight down through these corners: (mm, mm/s) each; mm is the height over the skin. (mm, 0, s) rests."""
    height, parts = 5.0, [np.array([5.0])]
    for mm, speed, *seconds in legs:
        n = max(1, round((seconds[0] if seconds else abs(mm - height) / speed) * RATE))
        parts.append(np.linspace(height, mm, n + 1)[1:])
        height = mm
    mm = np.concatenate(parts)
    return np.stack([np.zeros_like(mm), mm * 1e-3, np.zeros_like(mm)], axis=1)


def coached(write, position, *goals, head=HEAD, cuts=160, **columns):
    given = of_positions(SCENE, position) if isinstance(position, np.ndarray) else position
    return judged(load_exercise(write(*goals, head=head)), given | columns, cuts=cuts, scene=SCENE).finish().coaching


def about(remarks):
    return {remark.about: remark.text for remark in remarks}


STOP = goal("stop_after_pop", membrane="skin", within_mm=1)


def test_a_hand_that_still_pushes_when_the_wall_gives_is_told_the_force_and_how_far_it_went(write):
    # 2 mm/s up to the pop; then the needle springs on by 3.7 mm in 0.2 s.
    jump = way((-SKIN_POPS - 0.01, 2), (-SKIN_POPS - 3.7, 18.5), (-SKIN_POPS - 3.7, 0, 1))
    tips = coached(write, jump, STOP, REACH, head=DEEP)
    remark = tips.change[0]
    assert remark.about == "stop"
    skin = pn.ThickLaw(SCENE.needle, SCENE.membranes[0].membrane)
    front = pn.ThickLaw(SCENE.needle, SCENE.membranes[1].membrane)
    depth = np.linspace(SKIN_POPS - 0.2, SKIN_POPS, 1000) * 1e-3  # in the 0.1 s before the pop
    force = -(skin.bounds(depth)[0] + front.bounds(depth - 4.81e-3)[0]).min()
    assert remark.numbers["force_N"] == pytest.approx(force, rel=0.01)
    assert remark.numbers["distance_m"] == pytest.approx(3.7e-3, abs=2e-5)
    assert remark.text == (
        f"You were still pushing with {force:.2f} N when the skin gave way, and went 2.7 mm too far: "
        "go on in small steps when the resistance grows."
    )


def test_a_fast_hand_is_told_its_speed(write):
    tips = coached(write, way((-9, 25)), STOP, REACH, head=DEEP)
    assert tips.change[0].numbers["speed_m_per_s"] == pytest.approx(25e-3, rel=0.01)
    assert "You moved at 25 mm/s when the skin gave way, and went " in tips.change[0].text
    assert tips.change[0].text.endswith("too far: push more slowly when the resistance grows.")


def test_a_firm_stop_went_well(write):
    firm = way((-SKIN_POPS - 0.3, 4), (-SKIN_POPS - 0.3, 0, 1), (-6, 4), (-6, 0, 3))
    tips = coached(write, firm, STOP, STAY)
    assert "stop" not in about(tips.change)
    assert (
        about(tips.good)["stop"] == "You stopped well: only 0.3 mm past the skin when it gave way; 1.0 mm are allowed."
    )


def test_a_stop_that_was_close_is_told_though_it_passed(write):
    close = way((-SKIN_POPS - 0.9, 4), (-SKIN_POPS - 0.9, 0, 1), (-6, 4), (-6, 0, 3))
    tips = coached(write, close, STOP, STAY)
    assert about(tips.change)["stop"].startswith("You went 0.9 mm past the skin when it gave way; 1.0 mm are allowed: ")
    assert "stop" not in about(tips.good)


def test_going_through_the_wall_behind_is_told_with_speed_and_force(write):
    never = goal("never_pass", membrane="back vein wall")
    tips = coached(write, way((-12, 12)), STAY, never)
    remark = tips.change[0]
    assert remark.about == "through" and remark.numbers["speed_m_per_s"] == pytest.approx(12e-3, rel=0.01)
    assert remark.text.startswith("You still moved in at 12 mm/s, against ")
    assert remark.text.endswith("through the back vein wall: push more slowly, so that you have time to stop.")
    tips = coached(write, way((-7, 12), (-7, 0, 1), (-12, 12)), goal("stay", seconds=9), never)
    assert tips.change[0].text.endswith(" s after you reached the vein: draw back when the force grows.")
    assert "through" not in about(coached(write, way((-7, 12), (-7, 0, 3)), STAY, never).change)


def test_too_much_force_is_told_with_the_largest_one(write):
    limit = goal("peak_force", at_most_N=0.3)
    remark = coached(write, way((-6, 5)), limit, REACH).change[0]
    assert remark.text.startswith("You pushed with more than the 0.30 N that are allowed: push more gently, and stop")
    assert remark.numbers["force_N"] == pytest.approx(0.3, abs=0.005) and remark.numbers["force_N"] > 0.3
    gentle = coached(write, way((-6, 5), (-6, 0, 3)), goal("peak_force", at_most_N=3), STAY)
    assert "force" not in about(gentle.change)
    assert about(gentle.good)["force"].startswith("You never pushed with more than 0.")


@pytest.mark.parametrize(("degrees", "tips"), [(78, "hold the needle 12 degrees steeper"), (86.5, None), (89, None)])
def test_the_angle_of_entry(write, degrees, tips):
    columns = of_positions(SCENE, way((-1, 5), (-1, 0, 1.5), (-7, 5)))  # a pause, so that the angle is among the best
    slanted = np.array([np.cos(np.radians(degrees)), -np.sin(np.radians(degrees)), 0])
    columns["direction"] = np.tile(slanted, (*columns["depth"].shape, 1))
    words = coached(write, columns, goal("reach", depth_mm=1))
    assert (tips or "") in about(words.change).get("angle", "")
    assert ("angle" in about(words.change)) == (tips is not None)
    assert ("angle" in about(words.good)) == (degrees == 89)


def test_a_needle_that_stays_short_of_the_space_is_told_by_how_much(write):
    tips = coached(write, way((-4, 5), (-4, 0, 1)), REACH)
    assert about(tips.change)["short"] == (
        "The point stayed 1.2 mm or more away from the vein: push on until you notice the flash-back."
    )
    assert "short" not in about(coached(write, way((-6, 5)), REACH).change)


def test_a_tip_that_is_only_partly_in_the_space_is_told_how_much_is_outside(write):
    half = way((-7, 5), (-7, 0, 3))
    tips = coached(write, half, REACH, goal("stay", seconds=2, whole_tip=True), head=DEEP)
    outside = 5.21 + SKIN_POPS - 1.2 - 7
    assert about(tips.change)["short"].startswith(
        f"The point was in the vein, but the end of the tip was still {outside:.1f} mm outside"
    )
    whole = coached(write, way((-10, 5), (-10, 0, 3)), goal("stay", seconds=2, whole_tip=True), head=DEEP)
    assert "short" not in about(whole.change)


def test_pressing_on_the_wall_behind_is_told_with_time_and_depth(write):
    tips = coached(write, way((-8.5, 5), (-8.5, 0, 1.5), (-7, 5)), goal("stay", seconds=9))
    assert about(tips.change)["pressed"].startswith(
        "You were against the back vein wall for 1.6 s, up to 0.3 mm behind"
    )
    assert "pressed" not in about(coached(write, way((-8, 5), (-8, 0, 1.5)), goal("stay", seconds=9)).change)


def test_leaving_the_space_is_told_with_the_longest_stay(write):
    tips = coached(write, way((-6, 5), (-6, 0, 1.2), (-4, 5), (-6, 5), (-6, 0, 0.4)), goal("stay", seconds=3))
    assert (
        "You left the vein once before you had held for 3 s; your longest stay was 1.5 s" in about(tips.change)["left"]
    )
    assert "left" not in about(coached(write, way((-6, 5), (-6, 0, 3)), STAY).change)


def test_entering_again_is_told_where_entries_count(write):
    again = way((-2, 5), (2, 5), (-2, 5), (2, 5), (-6, 5))
    tips = coached(write, again, REACH, goal("entries", at_most=3))
    assert about(tips.change)["entries"].startswith("You came out of the skin and entered again twice: ")
    assert "entries" not in about(coached(write, again, REACH).change)
    assert "entries" not in about(coached(write, way((-6, 5)), REACH, goal("entries", at_most=3)).change)


def shaken(rms, drift=0.0):
    """Held in the vein from 2.0 s on, with a tremor of 8 Hz; from 2.6 s on it drifts for 2 s."""
    position = way((-6, 5), (-6, 0, 4))
    time = np.arange(len(position)) / RATE
    position[:, 0] += rms * np.sqrt(2) * np.sin(2 * np.pi * 8 * time) + drift * np.clip((time - 2.6) / 2, 0, 1)
    return position


@pytest.mark.parametrize(
    ("rms", "named", "praised"), [(0.25e-3, True, False), (0.1e-3, False, False), (2e-5, False, True)]
)
def test_tremor_while_holding_is_measured(write, rms, named, praised):
    tips = coached(write, shaken(rms), goal("stay", seconds=3.5))
    assert ("tremor" in about(tips.change), "tremor" in about(tips.good)) == (named, praised)
    if named:
        assert tips.change[0].numbers["tremor_m"] == pytest.approx(rms, rel=0.05)


def test_drift_while_holding_is_not_tremor(write):
    tips = coached(write, shaken(0, drift=2e-3), goal("stay", seconds=3.5))
    assert "tremor" not in about(tips.change)
    assert about(tips.change)["drift"].startswith("The tip drifted by 2.0 mm while you held for 3.5 s")
    assert "drift" not in about(coached(write, shaken(0, drift=1e-3), goal("stay", seconds=3.5)).change)


def test_pauses_on_the_way_are_counted_and_timed(write):
    halting = way((-1, 5), (-1, 0, 2), (-3, 5), (-3, 0, 1.5), (-6, 5))
    tips = coached(write, halting, REACH)
    assert about(tips.change)["pauses"].startswith("You stood still twice in the tissue on the way, for 3.")
    assert "pauses" not in about(tips.good)
    steady = coached(write, way((3, 5), (3, 0, 3), (-6, 2)), REACH)  # waiting in front of the skin is no pause
    assert "pauses" not in about(steady.change) and "pauses" in about(steady.good)


def test_the_way_to_the_side_is_measured(write):
    crooked = ideal(SCENE, (0, 5, 0), (0, -3, 0), (2, -3, 0), (2, -6, 0))
    tips = coached(write, crooked, REACH)
    assert about(tips.change)["aside"] == (
        "The tip went up to 2.0 mm to the side of its line of entry: push along the needle."
    )
    straight = coached(write, way((-6, 5)), REACH)
    assert "aside" not in about(straight.change)
    assert about(straight.good)["aside"] == "You kept to the line of entry: the tip went less than 0.1 mm to its side."


def test_at_most_three_of_each_and_the_most_important_first(write):
    bad = way((-1, 5), (-1, 0, 3), (2, 5), (-1, 5), (-9, 30))
    columns = of_positions(SCENE, bad)
    columns["direction"][:] = [np.cos(1.3), -np.sin(1.3), 0]  # 74 degrees
    goals = goal("never_pass", membrane="back vein wall"), goal("entries", at_most=3)
    tips = coached(write, columns, STAY, *goals)
    assert [remark.about for remark in tips.change] == ["through", "angle", "entries"]
    columns["direction"][:] = [0, -1, 0]
    tips = coached(write, columns, STAY, *goals)
    assert [remark.about for remark in tips.change] == ["through", "entries", "pauses"]


BESIDE = goal("on_line", point_mm=[0, -6.7, 4], along=[1, 0, 0], within_mm=1)


def test_no_praise_contradicts_what_is_to_change(write):
    tips = coached(write, way((-7, 5), (-7, 0, 3)), STAY, BESIDE)
    assert tips.change[0].text.startswith("The point was 4.0 mm beside the middle line")
    assert about(tips.good).keys() == {"angle"}  # straight, steady, and beside the vein
    left = way((-6, 5), (-6, 0, 1.2), (-4, 5), (-6, 5), (-6, 0, 0.4))
    tips = coached(write, left, goal("stay", seconds=3))
    assert "left" in about(tips.change) and "tremor" not in about(tips.good)
    hit, never = BESIDE.replace("4]", "0]"), goal("never_pass", membrane="back vein wall")
    tips = coached(write, way((-7, 5), (-7, 0, 3)), STAY, hit, never)
    assert "to the side of its middle line" in about(tips.good)["line"]
    assert "line" not in about(coached(write, way((-12, 5), (-12, 0, 1)), STAY, hit, never).good)


LIMITS = [
    (goal("no_pause", seconds=1.5), way((-1, 5), (-1, 0, 3), (-7, 5)), "pauses", 2.7),
    (goal("depth", at_most_mm=1), way((-8, 5)), "depth", 2.24),  # 1 mm behind the wall of 0.4 mm at 4.81 mm
    (goal("entries", at_most=1), way((-1, 5), (2, 5), (-7, 5)), "entries", 2.2),
    (goal("entry_angle", angle_deg=87, within_deg=2), way((-7, 5)), "angle", 1.0),
]


@pytest.mark.parametrize(("limit", "position", "subject", "when"), LIMITS)
def test_the_first_thing_to_change_is_what_decided_with_its_moment(write, limit, position, subject, when):
    tips = coached(write, position, STAY, limit)
    assert tips.change[0].about == subject
    assert tips.change[0].time == pytest.approx(when, abs=0.05)
    assert len(about(tips.change)) == len(tips.change)  # each thing once


def test_the_words_do_not_depend_on_how_ticks_are_cut(write):
    bad = way((-1, 5), (-1, 0, 3), (-9, 30))
    never = goal("never_pass", membrane="back vein wall")
    tips = [coached(write, bad, STAY, STOP, never, cuts=cuts) for cuts in (29, 160, 100_000)]
    assert tips[0].change and tips[0] == tips[1] == tips[2]


def test_nothing_is_said_without_an_entry_or_after_a_fault(write):
    nothing = {"good": [], "change": []}
    assert coached(write, way((1, 5)), REACH).model_dump() == nothing
    columns = of_positions(SCENE, way((-6, 5)))
    columns["fault"][3000] = 1
    assert coached(write, columns, STAY).model_dump() == nothing


def test_missing_readings_make_no_numbers_up(write):
    position = way((-9, 25))
    position[np.arange(len(position)) % 2 == 1] = np.nan
    tips = coached(write, position, STOP, REACH, head=DEEP)
    assert all(np.isfinite(value) for remark in [*tips.good, *tips.change] for value in remark.numbers.values())


@pytest.mark.parametrize("scale, limit, unit", [(1, 0, " N"), (0.3, 0, " N (model force)"), (1, 2, " N (model force)")])
def test_a_force_that_the_hand_did_not_get_is_called_model_force(write, scale, limit, unit):
    position = way((-6, 4), (-6, 0, 3))
    n = len(position)
    columns = {"force_scale": np.full(n, float(scale)), "limit": np.full(n, limit, np.uint8)}
    tips = coached(write, position, goal("peak_force", at_most_N=5), REACH, head=DEEP, **columns)
    force = about(tips.good)["force"].removeprefix("You never pushed with more than ")
    number, rest = force[:4], force[4:]
    assert float(number) > 0.1 and rest == f"{unit}; 5.00 N are allowed."

"""Poses at any rate move a needle as its ticks would."""

import math

import numpy as np
import punctura as pn
import pytest
from punctura.poses import PosedNeedle, PoseWarning

SCENE = pn.load_scene("k06-fig12")
RATE = SCENE.servo.rate
AXIS = np.array([0.1, -1.0, 0.0])


def positions(count):
    return np.linspace(-1e-3, 9e-3, count)[:, None] * AXIS


def test_a_pose_a_tick_gives_the_forces_of_the_core():
    needle, p = PosedNeedle(SCENE), positions(800)
    forces = [needle.move(1.8e9 + k / RATE, p[k], AXIS) for k in range(len(p))]
    assert np.array_equal(forces, pn.Insertion(SCENE).run(p, AXIS).force)
    assert np.abs(forces).max() > 0.5 and needle.starts == 1


def test_slower_poses_move_on_straight_lines():
    needle, p = PosedNeedle(SCENE), positions(801)
    forces = [needle.move(k / RATE, p[k], AXIS) for k in range(0, len(p), 16)]
    expected = pn.Insertion(SCENE).run(p, AXIS).force[::16]
    assert np.allclose(forces, expected, atol=1e-9)


@pytest.mark.parametrize("length", [1e6, 1e-320, 1e308])
def test_the_length_of_an_axis_has_no_weight_between_two_poses(length):
    needle, other = PosedNeedle(SCENE), PosedNeedle(SCENE)
    for k, p in enumerate(positions(51)):
        axis = np.array([0.0, -1.0, 0.0]) if k % 2 else np.array([1.0, 0.0, 0.0])
        expected = needle.move(k / 100, p, axis)
        assert np.allclose(other.move(k / 100, p, axis * (length if k % 2 else 1)), expected, rtol=0, atol=1e-12)
    assert np.abs(expected).max() > 0.1


def test_faster_poses_than_ticks_leave_the_force_between_two_ticks():
    needle = PosedNeedle(SCENE)
    p = positions(3001)
    forces = np.array([needle.move(k / (3 * RATE), p[k], AXIS) for k in range(len(p))])
    assert np.allclose(forces[::3], pn.Insertion(SCENE).run(p[::3], AXIS).force, atol=1e-9)
    assert np.array_equal(forces[1::3], forces[:-1:3])


def moved(times, points=None, **options):
    """The needle after poses at these times, its forces (n, 3), and what it says."""
    notices = []
    needle = PosedNeedle(SCENE, notice=notices.append, **options)
    points = positions(len(times)) if points is None else points
    forces = np.array([needle.move(t, p, AXIS) for t, p in zip(times, points, strict=True)])
    return needle, forces, notices


@pytest.mark.parametrize("step", [5.0, -5.0, 0.26, -0.26])
def test_a_gap_and_a_step_of_the_clock_start_anew_and_are_told(step):
    times = np.arange(800) / RATE
    times[500:] += step
    needle, forces, notices = moved(times)
    assert forces[499].any() and not forces[500].any() and needle.starts == 2 and len(notices) == 1
    place = f"at ({', '.join(f'{x * 1e3:.2f}' for x in positions(800)[500])}) mm"
    assert f"comes {times[500] - times[499]:+.3g} s after the last one" in notices[0] and place in notices[0]
    assert "(restart 1)" in notices[0] and "'second membrane' and gets no force there until" in notices[0]
    with pytest.warns(PoseWarning, match="needs hold_last_pose"):
        other = PosedNeedle(SCENE)
        for t, p in zip(times, positions(800), strict=True):
            other.move(t, p, AXIS)


def test_a_pose_that_comes_after_a_later_one_is_dropped_and_counted():
    times, late = np.arange(0, 0.5, 0.01), [10, 20, 30]
    swapped, shifted = times.copy(), times.copy()
    swapped[[20, 21]] = swapped[[21, 20]]
    shifted[late] = shifted[np.array(late) - 1] - 1e-6
    for changed, dropped in ((swapped, [21]), (shifted, late)):
        needle, forces, notices = moved(changed)
        kept = np.delete(np.arange(len(times)), dropped)
        _, expected, nothing = moved(changed[kept], positions(len(times))[kept])
        assert np.array_equal(forces[kept], expected) and np.array_equal(forces[dropped], forces[np.array(dropped) - 1])
        assert (needle.dropped, needle.starts) == (len(dropped), 1)
        assert len(notices) == 1 and "is dropped; 1 of these so far" in notices[0] and not nothing


@pytest.mark.parametrize(("factor", "unit"), [(1e3, "ms, so multiply them by 0.001"), (1e6, "us"), (1e9, "ns")])
def test_times_in_another_unit_are_told_once(factor, unit):
    _, forces, notices = moved(np.arange(0, 0.5, 0.01) * factor)
    assert not forces.any() and len(notices) == 2
    assert f"no force. Their times must be in seconds: they seem to be in {unit}" in notices[1]


@pytest.mark.parametrize("time", [1.79e12, 1.79e18, 5e12])  # since 1970 in ms and ns; in ns since a start
def test_a_time_that_is_in_no_seconds_is_refused_and_its_unit_is_not_guessed(time):
    needle = PosedNeedle(SCENE)
    with pytest.raises(ValueError, match=r"in seconds, and .* is not: multiply ms by 1e-3, us by 1e-6, ns by 1e-9"):
        needle.move(time, [0, 0, 0], AXIS)
    assert needle.starts == 0


def test_a_time_that_stands_still_is_told():
    needle, _, notices = moved(np.full(300, 7.0))
    assert len(notices) == 1 and "100 poses have the time 7.000000 s: the force stays" in notices[0]
    assert needle.starts == 1
    assert not moved(np.repeat(np.arange(0, 0.5, 0.01), 2))[2]


@pytest.mark.parametrize("late", [0.4, 50.0])
def test_a_held_pose_keeps_the_insertion(late):
    times, still = np.arange(0, 0.5, 0.01), 30
    paused = times.copy()
    paused[still:] += late
    needle, forces, notices = moved(paused, hold_last_pose=True)
    # As a sender that goes on at the last pose, and then moves within the longest gap.
    rests = np.arange(times[still - 1] + 0.01, paused[still] - 0.25, 0.01)
    filled = np.concatenate([times[:still], rests, [paused[still] - 0.25], paused[still:]])
    p = positions(len(times))
    points = np.concatenate([p[:still], np.repeat(p[still - 1 : still], len(rests) + 1, axis=0), p[still:]])
    _, expected, _ = moved(filled, points, longest_gap=0.26)
    assert np.allclose(forces[still:], expected[-(len(times) - still) :], atol=1e-9) and forces[still:].any()
    assert needle.starts == 1 and not notices


def test_hold_goes_on_by_itself_and_the_next_pose_may_be_a_little_older():
    notices = []
    needle = PosedNeedle(SCENE, hold_last_pose=True, notice=notices.append)
    assert not needle.hold(3.0).any()
    p = positions(50)
    for k in range(40):
        needle.move(0.01 * k, p[k], AXIS)
    for k in range(1, 31):
        needle.hold(0.39 + 0.1 * k)
    assert needle.force.any() and needle.starts == 1
    needle.move(3.38, p[41], AXIS)  # its message took longer than the hold expected
    assert needle.move(3.40, p[42], AXIS).any() and (needle.starts, needle.dropped) == (1, 0) and not notices
    with pytest.raises(ValueError, match="can be held for 3600 s"):
        needle.hold(1e5)


def test_a_hold_that_ran_ahead_of_the_sender_does_not_freeze_the_force():
    """The sender's clock stands still while it is paused; the caller of hold() has a clock of its own."""
    p = positions(80)
    needle, _, notices = moved(0.01 * np.arange(40), p[:40])
    needle.hold(300.0)
    forces = np.array([needle.move(0.01 * k, p[k], AXIS) for k in range(40, 80)])
    assert len(np.unique(forces[:, 1])) > 30 and needle.starts == 1 and not notices
    with pytest.raises(ValueError, match="can be held for 3600 s"):
        needle.hold(4000.0)


@pytest.mark.parametrize("gap", [math.nan, math.inf, 0, -1, 1e3])
def test_a_longest_gap_that_is_none_is_refused(gap):
    with pytest.raises(ValueError, match=f"longest_gap must be more than 0 and at most 60 s, not {gap}"):
        PosedNeedle(SCENE, longest_gap=gap)


@pytest.mark.parametrize("gap", ["x", None, [1, 2]])
def test_a_longest_gap_of_another_type_is_refused(gap):
    with pytest.raises(TypeError, match="must be real number"):
        PosedNeedle(SCENE, longest_gap=gap)


@pytest.mark.parametrize("point", [[0, 1], [0, 1, 2, 3], np.ma.array([0, 0, 0.0], mask=[1, 0, 0]), [0, 0, 1j]])
def test_a_position_is_three_real_numbers(point):
    with pytest.raises(ValueError, match="position must be three real numbers"):
        PosedNeedle(SCENE).move(0.0, point, AXIS)


@pytest.mark.parametrize("wrong", [(math.nan, [0, 0, 0], AXIS), (0, [0, math.inf, 0], AXIS), (0, [0, 0, 0], [0, 0, 0])])
def test_what_is_no_pose_is_refused_and_changes_nothing(wrong):
    needle, other = PosedNeedle(SCENE), PosedNeedle(SCENE)
    for k, p in enumerate(positions(800)):
        if k == 500:
            with pytest.raises(ValueError, match="must be finite"):
                needle.move(*wrong)
        assert np.array_equal(needle.move(k / RATE, p, AXIS), other.move(k / RATE, p, AXIS))

"""Poses at any rate move a needle as its ticks would."""

import math

import numpy as np
import punctura as pn
import pytest
from punctura.poses import PosedNeedle

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


def test_faster_poses_than_ticks_leave_the_force_between_two_ticks():
    needle = PosedNeedle(SCENE)
    p = positions(3001)
    forces = np.array([needle.move(k / (3 * RATE), p[k], AXIS) for k in range(len(p))])
    assert np.allclose(forces[::3], pn.Insertion(SCENE).run(p[::3], AXIS).force, atol=1e-9)
    assert np.array_equal(forces[1::3], forces[:-1:3])


def test_a_gap_and_a_time_that_goes_back_start_anew():
    needle = PosedNeedle(SCENE)
    for k, p in enumerate(positions(800)):
        needle.move(k / RATE, p, AXIS)
    assert needle.force.any()
    assert not needle.move(5.0, positions(2)[-1], AXIS).any() and needle.starts == 2
    needle.move(4.0, positions(2)[0], AXIS)
    assert needle.starts == 3


@pytest.mark.parametrize("wrong", [(math.nan, [0, 0, 0], AXIS), (0, [0, math.inf, 0], AXIS), (0, [0, 0, 0], [0, 0, 0])])
def test_what_is_no_pose_is_refused_and_changes_nothing(wrong):
    needle, other = PosedNeedle(SCENE), PosedNeedle(SCENE)
    for k, p in enumerate(positions(800)):
        if k == 500:
            with pytest.raises(ValueError, match="must be finite"):
                needle.move(*wrong)
        assert np.array_equal(needle.move(k / RATE, p, AXIS), other.move(k / RATE, p, AXIS))

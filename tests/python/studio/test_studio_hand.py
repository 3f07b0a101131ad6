"""The simulated hand's scripts, and how long the page that moves it was silent."""

import numpy as np
import punctura as pn
import pytest
from punctura.studio import hand as module
from punctura.studio.hand import LEAD_S, REST_SHARE, Hand, Heard, resting_pose

SCENE = pn.load_scene("k06-fig12")


class Watched:
    """Replaces the simulated device and stores the positions that it gets."""

    def __init__(self):
        self.places, self.axes = [], []

    def move_to(self, place):
        self.places.append(place)

    def point(self, axis, buttons=0):
        self.axes.append(axis)


@pytest.fixture
def hand():
    made = Hand()
    made.take(None, resting_pose(SCENE))
    made._device, made.mode = Watched(), "target"
    return made


def test_it_rests_in_front_of_all_membranes_and_points_inward():
    place, axis = resting_pose(SCENE)
    assert place == pytest.approx((0, 5e-3, 0)) and axis == (0.0, -1.0, 0.0)


def test_in_a_scene_with_blood_it_rests_close_to_the_skin_at_thirty_degrees():
    scene = pn.load_scene("venipuncture")
    place, axis = map(np.array, resting_pose(scene))
    inward = np.array(scene.membranes[0].inward_normal)
    assert np.degrees(np.arcsin(axis @ inward)) == pytest.approx(30)
    height = (np.array(scene.membranes[0].point) - place) @ inward
    assert height / (axis @ inward) == pytest.approx(3e-3), "3 mm along the needle"
    middle = place + axis * (height + 4.31e-3) / (axis @ inward)  # half of the depth to the far side of the back wall
    assert middle == pytest.approx((0, -4.31e-3, 0), abs=1e-9)


def test_of_a_real_device_it_does_nothing():
    hand = Hand()
    hand.take(None, resting_pose(SCENE))
    hand.target([0.0, 0.0, 0.0], [0.0, -1.0, 0.0])
    hand.drive(1.0)
    assert hand.mode == "device" and hand.next_at == float("inf")


def test_strokes_rest_at_both_ends_and_never_jump(hand):
    hand.strokes(SCENE, 2.0, now=10.0)
    for k in range(1000):
        hand.drive(10.0 + k * 0.004)
    y = np.array([p[1] for p in hand._device.places])
    assert y[0] == pytest.approx(5e-3) and y[: int(REST_SHARE * 250)].max() == y[: int(REST_SHARE * 250)].min()
    assert y.min() < -5e-3 and np.abs(np.diff(y)).max() < 5e-4
    assert y[500] == pytest.approx(y[0], abs=1e-5)
    hand.target([0.0, 0.0, 0.0], [0.0, -2.0, 0.0])
    assert hand.mode == "target" and hand.next_at == float("inf") and hand._device.axes[-1] == (0.0, -1.0, 0.0)


def test_a_motion_is_led_into_without_a_jump_and_ends(hand):
    time = np.linspace(0, 0.5, 126)
    tip = np.column_stack((np.zeros(126), -0.01 - 0.01 * time, np.zeros(126)))
    hand.motion(time, tip, np.tile([0.0, -1.0, 0.0], (126, 1)), now=3.0)
    for k in range(int((LEAD_S + 1) * 250)):
        hand.drive(3.0 + k * 0.004)
    y = np.array([p[1] for p in hand._device.places])
    assert np.abs(np.diff(y)).max() < 3e-4 and y[-1] == pytest.approx(tip[-1, 1]) and hand.mode == "target"


@pytest.mark.parametrize(
    ("place", "axis"), [((9, 0, 0), (0, -1, 0)), ((0, 0, 0), (0, 0, 0)), ((0, 0, 0), (1e200, 1e200, 0))]
)
def test_what_is_no_target_moves_nothing(hand, place, axis):
    with pytest.raises(ValueError, match="axis"):
        hand.target(list(place), list(axis))
    assert not hand._device.places


@pytest.fixture
def clock(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(module.time, "monotonic", lambda: now[0])
    return now


def test_each_tick_has_the_time_since_the_last_word(clock):
    heard = Heard()
    for clock[0] in (100.0, 100.1, 103.2):
        heard.hear(awake=True)
    times = np.array([0.9, 1.0, 1.05, 1.1, 2.0, 4.2])  # the last tick is that of the moment 103.2
    assert heard.age(times, 103.2) == pytest.approx([0.0, 0.0, 0.05, 0.0, 0.9, 0.0])


def test_a_page_that_never_says_that_it_is_awake_is_never_late(clock):
    heard = Heard()
    heard.hear()
    clock[0] = 200.0
    assert heard.age(np.array([0.0, 100.0]), 200.0) == pytest.approx([0.0, 0.0])
    heard.hear(awake=True)
    clock[0] = 200.5
    heard.hear()  # from now on a target is a word, too
    assert heard.age(np.array([1.0, 1.5]), 201.0) == pytest.approx([0.0, 0.5])
    heard.forget()
    assert heard.age(np.array([1.0, 9.0]), 208.5) == pytest.approx([0.0, 0.0])

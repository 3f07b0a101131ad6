"""What of punctura.mujoco needs no MuJoCo: frames, the implicit force, the bound, the message without the package.

integrations/mujoco/test.sh tests the rest.
"""

import sys
from types import SimpleNamespace

import numpy as np
import punctura as pn
import punctura.mujoco
import pytest
from punctura.mujoco.implicit import solve
from punctura.mujoco.kinematics import seen_from
from punctura.scene import ServoSettings

RNG = np.random.default_rng(13)
NEEDLE, COUPLING, T = pn.Needle(1.08e-3, 0.28), pn.Coupling(400, 1), 2e-3


def insertion(thickness: float = 1e-3) -> pn.Insertion:
    wall = pn.PlacedMembrane("wall", pn.Membrane(570, 0.41, 0.2, thickness), (0, 0, 0), (0, 0, -1))
    return pn.Insertion(pn.Scene("wall", NEEDLE, COUPLING, [wall], ServoSettings(rate=1 / T, low_pass=0)))


def rotation(axis: np.ndarray, angle: float) -> np.ndarray:
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def test_the_jacobian_is_the_rate_of_the_tip_in_a_body_that_moves_and_turns():
    turn, drift, speed = RNG.normal(size=(3, 3))
    start, tip0, first = RNG.normal(size=3), RNG.normal(size=3), rotation(RNG.normal(size=3), 1.0)

    def seen(t: float):
        origin, frame, tip = start + t * drift, rotation(turn, t * np.linalg.norm(turn)) @ first, tip0 + t * speed
        of_tissue = drift + np.cross(turn, tip - origin)  # one velocity: the time
        return seen_from(tip, turn, speed[:, None], origin, frame, of_tissue[:, None])

    h = 1e-6
    rate = (seen(h)[0] - seen(-h)[0]) / (2 * h)
    assert np.allclose(seen(0)[2][:, 0], rate, atol=1e-8)
    assert np.allclose(seen(0.7)[1], seen(0)[1])  # a direction along the axis of the turn stays


def test_without_compliance_the_force_is_that_of_the_core_bit_for_bit():
    model, axis = insertion(), np.array([0, 0, -1.0])
    for z in np.linspace(1e-3, -8e-3, 300):
        tip = np.array([[1e-4 * z, 0, z]])
        expected = model.peek(tip[0], axis)
        place, force = solve(
            lambda p: np.array([model.peek(p[0], axis)]), tip, np.zeros((3, 3)), np.zeros((1, 3)), 900.0
        )
        assert (place == tip).all() and (force[0] == expected).all()
        model.step(tip[0], axis)


@pytest.mark.parametrize("mass", [1e-3, 1e-2])  # smallest_mass is 2.4 g
def test_a_light_needle_comes_to_rest_in_a_membrane(mass):
    """Backward Euler: x+ = x + T v+, m (v+ - v) = T f(x+). The friction takes all of its energy."""
    model, axis = insertion(), np.array([0, 0, -1.0])
    x, v, force = np.array([[0, 0, 1e-3]]), np.array([[0.02, 0, -0.2]]), np.zeros((1, 3))
    model.step(x[0], axis)
    compliance = np.eye(3) * T**2 / mass
    energies = []
    for _ in range(1500):
        free = x + T * v
        place, force = solve(lambda p: np.array([model.peek(p[0], axis)]), free, compliance, force, 2 * (400 + 1 / T))
        assert np.allclose(place, free + T**2 / mass * force, atol=1e-9)
        v, x = (place - x) / T, place
        model.step(x[0], axis)
        energies.append(0.5 * mass * (v**2).sum())
    assert model.phases == (pn.Phase.sticking,)
    assert energies[-1] < 1e-10 * energies[0]


@pytest.mark.parametrize(("share", "grows"), [(0.9, True), (1.1, False)])
def test_the_smallest_mass_separates_needles_that_oscillate_from_needles_that_rest(share, grows):
    mass = share * punctura.mujoco.smallest_mass(COUPLING, T)
    model, axis = insertion(), np.array([0, 0, -1.0])
    for z in np.linspace(1e-3, -6e-3, 2000):
        model.step((0, 0, z), axis)
    while model.step((0, 0, z), axis)[2] > 1e-4:  # draws back until the needle hangs in the membrane without force
        z += 1e-7
    x, v, swings = z + 1e-8, 0.0, []
    for _ in range(400):  # explicit: the force at the start of a step acts during the step
        v += T * model.step((0, 0, x), axis)[2] / mass
        x += T * v
        swings.append(abs(v))
    assert (max(swings[-10:]) > 10 * max(swings[:10])) == grows


def test_the_message_without_mujoco_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(ModuleNotFoundError, match=r"needs the package mujoco, of the extra 'mujoco'\. Install it: "):
        punctura.mujoco.attach(None, pn.load_scene("venipuncture"), "tip", "arm")


@pytest.mark.parametrize("version", ["2.3.7", "3.1.0", "3.17.0"])
def test_an_older_mujoco_is_refused_before_it_can_end_the_process(version, monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", SimpleNamespace(__version__=version))
    with pytest.raises(ModuleNotFoundError, match=rf"here is MuJoCo {version}, too old.* of the extra 'mujoco'"):
        punctura.mujoco.attach(None, pn.load_scene("venipuncture"), "tip", "arm")

"""The direction at entry, from the motion, and an exit after an entry that is barred."""

import itertools

import numpy as np
import punctura
import pytest
from oracles import cases, signal
from punctura.scene import ServoSettings

NEEDLE, MEMBRANE = punctura.Needle(1.08e-3, 0.28), punctura.Membrane(570.0, 0.41, 0.2, 1e-3)
COUPLING = punctura.Coupling(400.0, 1.0)
RATE = 1600.0
Z = np.array([0.0, 0.0, 1.0])
SOLVERS = ("exact", "paper")


def along_z(*depths):
    return np.concatenate([np.linspace(a, b, 400) for a, b in itertools.pairwise(depths)])[:, None] * Z


def tilted(degrees):
    return np.array([np.sin(np.deg2rad(degrees)), 0, np.cos(np.deg2rad(degrees))])


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_barred_tip_that_comes_out_never_makes_a_force_jump(solver):
    """From behind through the surface, and back: no force before the tip has been in front."""
    p = punctura.Proxy3d(NEEDLE, MEMBRANE, [0, 0, 0], Z, COUPLING, 1 / RATE, solver=solver)
    assert not p.run(along_z(20e-3, -2e-3), -Z).force.any()
    first = np.linalg.norm(p.run(along_z(-2e-3, 2e-3), Z).force, axis=1)
    assert np.diff(first).max() < 0.02


def curved(rng, ticks, rate, speed):
    """A smooth random path towards a membrane, every step longer than 4 micrometres."""
    t = np.arange(ticks) / rate
    side = rng.uniform(-1, 1, (2, 2)) * speed
    swing = rng.uniform(5, 40, 2)
    v = np.stack([side[0, 0] + side[0, 1] * np.sin(swing[0] * t), side[1, 0] + side[1, 1] * np.sin(swing[1] * t),
                  speed * np.where(np.sin(swing[0] * t / 3) > -0.5, 1, -1)], axis=1)  # fmt: skip
    return np.cumsum(v, axis=0) / rate - np.array([0, 0, 0.3 * ticks * speed / rate])


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_direction_from_the_motion_is_that_of_the_last_10_ms_or_the_last_tenths_of_a_millimetre(solver):
    """Against the transcription, on paths whose every step is longer than the marks that a fixed memory keeps."""
    rng = np.random.default_rng(61)
    entered = 0
    for _ in range(cases.count(60)):
        rate = rng.uniform(500, 4000)
        p = curved(rng, 300, rate, max(rng.uniform(4e-6 * rate, 0.03), 4e-6 * rate))
        placed = punctura.PlacedMembrane("m", MEMBRANE, [0, 0, 0], Z)
        servo = ServoSettings(rate, 0.0, solver)
        trace = punctura.Insertion(punctura.Scene("s", NEEDLE, COUPLING, [placed], servo, direction="motion")).run(p, Z)
        b = signal.motion_direction(p, rate)
        b[~b.any(axis=1)] = -Z  # a tip that has not moved has no direction, and does not enter
        follow = punctura.Proxy3d(NEEDLE, MEMBRANE, [0, 0, 0], Z, COUPLING, 1 / rate, solver=solver)
        assert abs(follow.run(p, b).force - trace.force).max() <= 1e-10
        entered += trace.force.any()
    assert entered > 0.5 * cases.count(60)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("rest", [0, 20_000])
def test_a_slow_hand_enters_in_the_direction_of_its_last_tenths_of_a_millimetre_at_any_speed(solver, rest):
    """0.05 mm/s: 10 ms are half a micrometre. The path bends 0.25 mm before the membrane, and may rest on the way."""
    b = tilted(30)
    straight = np.linspace(-0.25e-3, 1e-3, 40_000)[:, None] * b
    sideways = straight[0] + np.linspace(-1e-3, 0, 2000)[:, None] * tilted(-60)
    p = np.concatenate([sideways, straight[:7000], np.repeat(straight[6999:7000], rest, axis=0), straight[7000:]])
    placed = punctura.PlacedMembrane("m", MEMBRANE, [0, 0, 0], Z)
    servo = ServoSettings(RATE, 0.0, solver)

    def force(direction, axis):
        scene = punctura.Scene("s", NEEDLE, COUPLING, [placed], servo, direction=direction)
        return punctura.Insertion(scene).run(p, axis).force

    by_motion = force("motion", -Z)
    assert abs(by_motion).max() > 0.1
    assert abs(by_motion - force("stylus", b)).max() <= 1e-10

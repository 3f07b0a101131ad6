"""Events against the law: a slow needle meets the forces of Phi_I."""

import math

import numpy as np
import punctura as pn
import pytest
from punctura.events import EventFinder
from punctura.scene import ServoSettings
from punctura.simulation import Experiment, Strokes
from runs import along, ramp, unit

# Tolerance of the peak: a tick of 3 um misses it by at most this much.
TOLERANCE = 2e-3

NEEDLE, COUPLING = pn.Needle(1.08e-3, 0.28), pn.Coupling(400, 1)


def wall(thickness, stiffness=570, precompression=0.41, friction=0.2):
    return pn.Membrane(stiffness, precompression, friction, thickness)


def scene_of(membrane, solver="exact"):
    placed = [pn.PlacedMembrane("wall", membrane, (0, 0, 0), (0, -1, 0))]
    return pn.Scene("one wall", NEEDLE, COUPLING, placed, ServoSettings(low_pass=0, solver=solver))


def offline(scene, index, obliquity):
    """Largest resistance and shaft friction of the law, N."""
    placed = scene.membranes[index]
    tissue = placed.tissue or pn.Tissue()
    law = pn.TissueLaw(scene.needle, placed.membrane, tissue, obliquity)
    end = law.X + placed.membrane.thickness / math.cos(obliquity) + tissue.tail_length
    lower, _ = law.bounds(np.linspace(0, end, 200_001))
    return -float(lower.min()), -float(law.bounds(end + 1e-3)[0])


@pytest.mark.parametrize("solver", ["exact", "paper"])
@pytest.mark.parametrize("thickness", [0.0, 0.3e-3, 1e-3, 4e-3, 9e-3])
@pytest.mark.parametrize("degrees", [0, 30, 60])
def test_a_slow_pop_has_the_laws_peak_and_friction(thickness, degrees, solver):
    scene = scene_of(wall(thickness), solver)
    beta = math.radians(degrees)
    events = EventFinder(scene).add(along(scene, ramp(scene, -1e-3, 30e-3), (math.sin(beta), -math.cos(beta), 0)))
    assert [event.what for event in events] == ["touch", "pop"]
    peak, friction = offline(scene, 0, beta)
    pop = events[1]
    assert pop.force_before == pytest.approx(peak, rel=TOLERANCE)
    assert pop.force_after == pytest.approx(friction, rel=1e-12)
    assert pop.drop == pop.force_before - pop.force_after
    if peak - friction > 0.1 * peak:
        assert pop.drop == pytest.approx(peak - friction, rel=0.02)


@pytest.mark.parametrize("name", pn.scene_names())
def test_every_pop_of_the_ready_scenes_drops_as_the_law_says(name):
    scene = pn.load_scene(name)
    columns = along(scene, ramp(scene, -1e-3, 75e-3, speed=10e-3))
    pops = [event for event in EventFinder(scene).add(columns) if event.what == "pop"]
    assert sorted(pop.membrane for pop in pops) == list(range(len(scene.membranes)))
    for pop in pops:
        peak, friction = offline(scene, pop.membrane, 0)
        assert pop.name == scene.membranes[pop.membrane].name
        assert pop.force_before == pytest.approx(peak, rel=TOLERANCE)
        assert pop.force_after == pytest.approx(friction, rel=1e-12)
        assert pop.drop == pytest.approx(peak - friction, rel=0.02)


@pytest.mark.parametrize("name", ["k06-fig10", "venipuncture"])
def test_a_hands_pop_drops_as_the_law_says_within_2_percent(name):
    """Through the simulated device, its encoders, the tremor and the filter."""
    scene = pn.load_scene(name)
    normal = unit(scene.membranes[0].inward_normal)
    strokes = Strokes(-5e-3 * normal, 25e-3 * normal, count=1, duration=3.0, variation=0.0)
    trace = Experiment(scene, strokes, seed=4).run(5)
    columns = {k: getattr(trace, k) for k in ("time", "depth", "axial_force", "lower", "phase")}
    pops = [event for event in EventFinder(scene).add(columns) if event.what == "pop"]
    assert len(pops) == len(scene.membranes)
    for pop in pops:
        peak, friction = offline(scene, pop.membrane, 0)
        assert pop.drop == pytest.approx(peak - friction, rel=0.02)

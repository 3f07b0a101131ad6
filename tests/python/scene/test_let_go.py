"""Nobody holds the needle: the layers of the epidural scene keep it where it is, whatever its depth.

A wall pushes a needle out that is let go if its upper edge is below zero, A_O < 0 in K06 (15).
"""

import numpy as np
import pytest
from punctura import Insertion, Scene, TissueLaw, load_scene

DOWN = np.array([0.0, -1.0, 0.0])
SPEED = 20e-3  # m/s, of the insertion
DEPTHS = np.append(np.arange(0.25e-3, 62e-3, 0.5e-3), [50.1e-3, 62e-3])  # m, of the tip below the skin
RESTING = 1e-6  # N
STILL = 1e-9  # m


def epidural(solver: str, friction: float | None = None) -> Scene:
    scene = load_scene("epidural")
    if friction is not None:
        scene = scene.with_values({f"membrane[{i}].friction": friction for i in range(len(scene.membranes))})
    return scene.replace(servo=scene.servo.replace(solver=solver))


def let_go(needle: Insertion, depth: float, ticks: int) -> tuple[float, float]:
    """Depth and outward force after some ticks in which only the tissue moves the needle, without inertia."""
    softness = 1 / (len(needle.scene.membranes) * needle.scene.coupling.stiffness)
    force = 0.0
    for _ in range(ticks):
        force = -float(np.dot(needle.step(depth * DOWN, DOWN), DOWN))
        depth -= softness * force
    return depth, force


def recoils(scene: Scene):
    """For each depth: the force before the hand lets go, then how far the needle moves and what force is left; and
    how far it moves after that.
    """
    inserted = Insertion(scene)
    depth = -1e-3
    for deepest in np.sort(DEPTHS):
        way = np.append(np.arange(depth, deepest, SPEED / scene.servo.rate), deepest)
        depth = deepest
        inserted.run(way[:, None] * DOWN, DOWN)
        held = -float(np.dot(inserted.run(np.tile(depth * DOWN, (40, 1)), DOWN).force[-1], DOWN))
        free = Insertion(scene)
        free.state = inserted.state
        rest, left = let_go(free, depth, 400)
        later, _ = let_go(free, rest, 100)
        yield held, depth - rest, left, rest - later


@pytest.mark.parametrize("solver", ["exact", "paper"])
def test_a_needle_let_go_at_any_depth_of_the_epidural_stays(solver):
    scene = epidural(solver)
    forces = []
    for held, moved, left, later in recoils(scene):
        forces.append(held)
        # The tissue that the needle has bent springs back, by no more than its spring gives, and then nothing pushes.
        assert moved <= max(held, 0) / scene.coupling.stiffness + STILL
        assert abs(left) <= RESTING
        assert abs(later) <= STILL
    assert max(forces) > 10  # the flavum was bent when the hand let go


@pytest.mark.parametrize("solver", ["exact", "paper"])
def test_with_too_little_friction_the_same_needle_is_pushed_out(solver):
    scene = epidural(solver, friction=0.1)
    assert any(moved > max(held, 0) / scene.coupling.stiffness + STILL or later > STILL
               for held, moved, _, later in recoils(scene))  # fmt: skip


def test_no_layer_of_the_epidural_has_an_upper_edge_below_zero():
    scene = load_scene("epidural")
    for placed in scene.membranes:
        law = TissueLaw(scene.needle, placed.membrane, placed.tissue)
        depths = np.linspace(0, law.X + placed.membrane.thickness + 10e-3, 5000)
        _, upper = law.bounds(depths)
        assert np.min(upper) >= 0, placed.name
        slippery = TissueLaw(scene.needle, placed.membrane.replace(friction=0.1), placed.tissue)
        assert np.min(slippery.bounds(depths)[1]) < 0, placed.name

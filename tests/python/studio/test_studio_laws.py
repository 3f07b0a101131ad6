"""The curves of the laws that the page draws."""

import math

import numpy as np
import punctura as pn
import pytest
from punctura.studio.view import law_curves, obliquities

STEEPEST = math.radians(85)
THIN = pn.load_scene("k06-fig10")


@pytest.mark.parametrize("name", pn.scene_names())
@pytest.mark.parametrize("obliquity", [0.0, 0.7, STEEPEST])
def test_a_curve_is_the_law_at_every_point_and_has_its_extremes(name, obliquity):
    scene = pn.load_scene(name)
    for placed, curve in zip(scene.membranes, law_curves(scene, [obliquity] * len(scene.membranes)), strict=True):
        law = pn.TissueLaw(scene.needle, placed.membrane, placed.tissue or pn.Tissue(), obliquity)
        lower, upper = law.bounds(np.array(curve.depth))
        assert np.array_equal(curve.lower, lower) and np.array_equal(curve.upper, upper)
        assert np.all(np.diff(curve.depth) > 0) and curve.depth[0] < 0 < curve.through < curve.depth[-1]
        fine = law.bounds(np.linspace(0, curve.through, 20001))[0]
        assert min(curve.lower) == pytest.approx(float(fine.min()), rel=1e-3)


def test_the_drop_of_a_thin_membrane_is_a_step():
    membrane = pn.Membrane(570, 0.41, 0.2, 0.0)
    scene = THIN.replace(membranes=[pn.PlacedMembrane("thin", membrane, [0, 0, 0], [0, -1, 0])])
    (curve,) = law_curves(scene, [0.0])
    drop = np.diff(curve.lower)
    assert drop.max() > 0.2 and np.diff(curve.depth)[int(np.argmax(drop))] < 1e-15


def test_the_angle_is_that_of_the_stylus_or_of_the_way_the_needle_came_in():
    normal = np.array([0.0, -1.0, 0.0])
    slanted = np.array([1.0, -1.0, 0.0])
    assert obliquities(THIN, slanted) == pytest.approx([math.pi / 4])
    assert obliquities(THIN, slanted * 7, np.array([normal])) == pytest.approx([0.0])
    assert obliquities(THIN, slanted, np.full((1, 3), np.nan)) == pytest.approx([math.pi / 4])
    assert obliquities(THIN.replace(direction="motion"), slanted) == pytest.approx([0.0])
    assert obliquities(THIN, -normal) == pytest.approx([STEEPEST])
    assert obliquities(THIN, np.zeros(3)) == pytest.approx([0.0])

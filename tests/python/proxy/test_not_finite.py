"""A number that is not finite is rejected at the call and does not change the state."""

import numpy as np
import punctura as pn
import pytest

NAN, INF = float("nan"), float("inf")
DOWN = (0, -1, 0)


def line():
    law = pn.ThickLaw(pn.Needle(1.08e-3, 0.28), pn.Membrane(570, 0.41, 0.2, 1e-3))
    return pn.Proxy1d(law, pn.Coupling(400, 1), 1 / 1600)


def space():
    needle, wall = pn.Needle(1.08e-3, 0.28), pn.Membrane(570, 0.41, 0.2, 1e-3)
    return pn.Proxy3d(needle, wall, (0, 0, 0), DOWN, pn.Coupling(400, 1), 1 / 1600)


def insertion():
    return pn.Insertion(pn.load_scene("k06-fig12"))


def depths(n=2000):
    return np.linspace(-1e-3, 9e-3, n)


def positions(n=2000):
    return depths(n)[:, None] * np.array(DOWN)


@pytest.mark.parametrize("bad", [NAN, INF, -INF])
@pytest.mark.parametrize("make", [space, insertion])
def test_in_space_the_argument_is_named_and_the_state_stays(make, bad):
    touched, clean = make(), make()
    for p, axis, says in [
        ((0, bad, 0), DOWN, "p must be finite"),
        ((0, 0, 0), (0, bad, 0), "axis must be finite"),
        ((0, 0, 0), (0, 0, 0), "axis must be a direction"),
    ]:
        with pytest.raises(ValueError, match=says):
            touched.step(p, axis)
    spoilt = positions()
    spoilt[7, 1] = bad
    with pytest.raises(ValueError, match=r"p\[7\] must be finite .* No tick was made"):
        touched.run(spoilt, DOWN)
    axes = np.tile(np.array(DOWN, float), (2000, 1))
    axes[11] = 0
    with pytest.raises(ValueError, match=r"axis\[11\] must be a direction"):
        touched.run(positions(), axes)
    gave, wanted = touched.run(positions(), DOWN).force, clean.run(positions(), DOWN).force
    assert np.array_equal(gave, wanted) and np.isfinite(gave).all()


@pytest.mark.parametrize("bad", [NAN, INF])
def test_on_a_line_the_argument_is_named_and_the_state_stays(bad):
    touched, clean = line(), line()
    with pytest.raises(ValueError, match="p must be finite"):
        touched.step(bad)
    with pytest.raises(ValueError, match=r"p\[3\] must be finite"):
        touched.run([0, 0, 0, bad])
    assert np.array_equal(touched.run(depths()).force, clean.run(depths()).force)

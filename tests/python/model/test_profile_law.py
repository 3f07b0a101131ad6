"""The law of a profile."""

import pickle
from typing import Literal

import numpy as np
import punctura as pn
import pytest

GEL = pn.ProfileLaw(depth=[0, 0.01, 0.03], lower=[0, -0.5, -0.2], upper=[0.1, 0.5, 0.2])
WALL = pn.ProfileLaw([0, 3e-3, 3e-3, 5e-3], [-0.1, -0.7, -0.4, -0.3], [0, 0.1, 0.4, 0.3], 1e-3, 0.4)


def test_the_force_is_linear_in_the_knots_values() -> None:
    q = np.linspace(-1e-3, 9e-3, 50).reshape(5, 10)
    weights = WALL.weights(q)
    assert weights.shape == (5, 10, 4)
    lower, upper = WALL.bounds(q)
    assert np.allclose(weights @ WALL.lower, lower, atol=1e-13)
    assert np.allclose(weights @ WALL.upper, upper, atol=1e-13)
    assert WALL.weights(1.0) == pytest.approx(np.array([0, 0, 0, 1 / np.cos(0.4)]))


def test_it_is_a_value() -> None:
    assert pickle.loads(pickle.dumps(WALL)) == WALL == WALL.replace() != WALL.replace(thickness=0)
    assert repr(GEL).startswith("ProfileLaw(depth=(0.0, 0.01, 0.03), lower=")


@pytest.mark.parametrize("solver", ["exact", "paper"])
def test_a_proxy_slides_on_its_edges(solver: Literal["exact", "paper"]) -> None:
    slope = pn.ProfileLaw([0, 30e-3], [0, -1.5], [0, 1.5])
    proxy = pn.Proxy1d(slope, pn.Coupling(400, 1), 1 / 1600, solver)
    ticks = proxy.run(np.concatenate([np.linspace(-1e-3, 20e-3, 800), np.linspace(20e-3, 0, 800)]))
    sliding_in = (ticks.phase == pn.Phase.sliding_in.value) & (ticks.depth > 0)
    assert sliding_in.sum() > 500 and np.allclose(ticks.force[sliding_in], -50 * ticks.depth[sliding_in])
    sliding_out = (ticks.phase == pn.Phase.sliding_out.value) & (ticks.depth > 0)
    assert sliding_out.sum() > 300 and np.allclose(ticks.force[sliding_out], 50 * ticks.depth[sliding_out])
    again = pickle.loads(pickle.dumps(proxy))
    assert again.step(0.01) == proxy.step(0.01)


def test_every_problem_of_a_profile_is_told() -> None:
    with pytest.raises(pn.ConfigurationError) as caught:
        pn.ProfileLaw([0, 0, 0.1], [0, 0, -1], [0, 0, -1.5])
    assert [problem.path for problem in caught.value.problems] == ["depth[1]", "lower[2]"]
    with pytest.raises(pn.ConfigurationError, match="the lower edge resists insertion"):
        pn.ProfileLaw([0], [1], [1.2])
    with pytest.raises(pn.ConfigurationError, match=r"^1 problem\n  len\(depth\) = 33.0: must be 1 to 32 knots$"):
        pn.ProfileLaw(range(33), [0] * 33, range(33))
    with pytest.raises(TypeError, match=r"depth must be a list of numbers, not str\."):
        pn.ProfileLaw("a", [0], [1])
    with pytest.raises(pn.ConfigurationError, match=r"len\(lower\) = 1.0: must be the number of depths, 2"):
        pn.ProfileLaw([0, 1], [0], [0, 0])
    with pytest.raises(pn.ConfigurationError, match="thickness"):
        pn.ProfileLaw([0], [0], [0], -1)

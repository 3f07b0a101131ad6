"""The law of measured tissue, from Python."""

import pickle

import numpy as np
import punctura as pn
import pytest
from numpy.typing import NDArray

NEEDLE = pn.Needle(diameter=1.27e-3, tip_angle=0.3)
WALL = pn.Membrane(stiffness=400, precompression=0.1, friction=0.2, thickness=0.5e-3)
COUPLING = pn.Coupling(4000, 1)
F = pn.ThickLaw(NEEDLE, WALL).F


def strokes(insertions: int = 2) -> NDArray[np.float64]:
    """In and out between 1 mm in front and 9 mm deep, m."""
    return np.concatenate([4e-3 - 5e-3 * np.cos(np.arange(6400) * np.pi / 3200)] * insertions)


def forces(tissue: pn.Tissue) -> NDArray[np.float64]:
    """The force that resists insertion in each stroke (2, 6400), N."""
    proxy = pn.Proxy1d(pn.TissueLaw(NEEDLE, WALL, tissue), COUPLING, 1 / 1600)
    return -proxy.run(strokes()).force.reshape(2, 6400)


def test_a_set_lowers_the_second_plateau_and_a_tail_both() -> None:
    force = forces(pn.Tissue(set=0.3, tail_length=1e-3, tail_floor=0.5))
    assert force[0, 3190] == pytest.approx(0.5 * F)
    assert force[1, 3190] == pytest.approx(0.7 * 0.5 * F)


def test_it_is_a_value_and_a_proxy_keeps_its_hole() -> None:
    law = pn.TissueLaw(NEEDLE, WALL, pn.Tissue(grip="table", grip_table=[(0, 0.1), (2e-3, 0.9)], cutting=0.2), 0.3)
    assert pickle.loads(pickle.dumps(law)) == law != law.replace(obliquity=0)
    proxy = pn.Proxy1d(law, COUPLING, 1 / 1600)
    proxy.run(strokes(1))
    again = pickle.loads(pickle.dumps(proxy))
    assert np.array_equal(again.run(strokes(1)).force, proxy.run(strokes(1)).force)


def test_every_problem_is_told() -> None:
    with pytest.raises(pn.ConfigurationError) as caught:
        pn.TissueLaw(NEEDLE, WALL, pn.Tissue(set=2, tail_floor=-1))
    assert [problem.path for problem in caught.value.problems] == ["tissue.tail_floor", "tissue.set"]
    with pytest.raises(pn.ConfigurationError, match="28 chords"):
        pn.TissueLaw(NEEDLE, WALL.replace(thickness=0), pn.Tissue(grip="exponential", growth=5000))

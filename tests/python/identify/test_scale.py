"""The same law in another size is found the same: from microneedles (uN) to trocars (500 N)."""

import numpy as np
import punctura as pn
import pytest
from punctura.identify import identify
from punctura.trace import Trace
from punctura.trace.findings import examine
from traces import MEMBRANE, NEEDLE, RATE, motion

POWERS = {"N": (1, 0), "m": (0, 1), "N/m": (1, -1), "-": (0, 0), "s": (0, 0)}  # of the factors of force and depth


def found(force, depth, walls, stiffness=1500):
    """What is identified where force and depth are so many times larger, over these factors."""
    time, way = motion()
    law, spring = pn.ThickLaw(NEEDLE, MEMBRANE), pn.Coupling(stiffness, 0.01)
    resists = sum(-pn.Proxy1d(law, spring, 1 / RATE).run(way - surface).force for surface in (5e-3, 8e-3)[:walls])
    noise = 8e-3 * np.random.default_rng(3).normal(size=len(way))
    made = examine(Trace(depth * way, force * (resists + noise), time))
    result = identify(made, pn.Needle(depth * NEEDLE.diameter, NEEDLE.tip_angle))
    assert result.doubts.whole
    return {
        one.name: np.array([one.low, one.value, one.high], float) / (force**of_force * depth**of_depth)
        for one in result.estimates
        for of_force, of_depth in [POWERS[one.unit]]
    }


@pytest.mark.parametrize("walls", [1, 2])
def test_a_law_of_another_size_has_the_same_values_and_intervals(walls):
    usual = found(1, 1, walls)
    for force, depth in ((1e-3, 1), (1e3, 1), (1, 0.1), (1, 10), (1e-6, 0.1), (1, 1e-3)):
        other = found(force, depth, walls)
        assert list(other) == list(usual)
        for name, values in usual.items():
            share = 1e-6 if depth in (1, 1e-3) else 0.25  # a search may end elsewhere within the sample of a pop
            near = share * (values[2] - values[0] if np.isfinite(values).all() else abs(values[1]))
            np.testing.assert_allclose(other[name], values, rtol=0, atol=near, err_msg=f"{force} {depth} {name}")


@pytest.mark.parametrize(("force", "depth"), [(0.03, 0.02), (0.05, 0.012), (26, 20)])
def test_a_soft_spring_is_in_the_bounds_at_every_size(force, depth):
    low, value, high = found(force, depth, 1, 400)["coupling_stiffness"]
    assert low < value < high and value == pytest.approx(400, rel=0.02)

"""The last fit uses all samples: an optimum that only fewer samples prefer does not win."""

import numpy as np
import punctura as pn
import pytest
from punctura.identify import identify
from punctura.trace import Trace

NEEDLE = pn.Needle(1.27e-3, np.radians(20))
WALLS = ((2e-3, pn.Membrane(500, 0.15, 0.15, 0.4e-3)), (10e-3, pn.Membrane(350, 0.1, 0.2, 0.8e-3)))


def two_insertions() -> Trace:
    """Both walls at 100 Hz: in, hold, out, and the same again without a hold. The model runs at 1 kHz."""
    turns = np.array([0, 22e-3, 22e-3, 0, 0, 22e-3, 0])
    way = 22e-3 / 5e-3
    times = np.cumsum([0, way, 3.0, way, 0.5, way, way])
    time, fine = np.arange(0, times[-1], 0.01), np.arange(0, times[-1], 0.001)
    depth, force = np.interp(fine, times, turns), np.zeros(len(fine))
    for surface, wall in WALLS:
        proxy = pn.Proxy1d(pn.ThickLaw(NEEDLE, wall), pn.Coupling(1500, 0.1), 1e-3)
        force -= proxy.run(depth - surface).force
    noise = 0.01 * np.random.default_rng(3).normal(size=len(time))
    return Trace(np.interp(time, times, turns).round(7), (np.interp(time, fine, force) + noise).round(4), time)


@pytest.mark.statistics
def test_a_thin_wall_in_a_long_trace_is_found():
    found = identify(two_insertions(), NEEDLE)
    assert found.fit.rmse == pytest.approx(0.01, rel=0.03)
    for number, (surface, wall) in enumerate(WALLS):
        assert found.parameters.get(f"membrane[{number}].surface") == pytest.approx(surface, abs=3e-5)
        assert found.parameters.get(f"membrane[{number}].thickness") == pytest.approx(wall.thickness, rel=0.05)

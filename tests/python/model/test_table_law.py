"""A law of one's own: a table."""

import pickle

import numpy as np
import punctura as pn
import pytest

GEL = pn.TableLaw(depth=[0, 0.01, 0.03], lower=[0, -0.5, -0.2], upper=[0.1, 0.5, 0.2])


def test_the_band_is_interpolated_and_constant_behind_the_last_knot():
    q = np.array([-1e-3, 0, 5e-3, 0.01, 0.02, 0.05])
    lower, upper = GEL.bounds(q)
    assert np.allclose(lower[1:], np.interp(q[1:], GEL.depth, GEL.lower)) and lower[0] == 0
    assert np.allclose(upper[1:], np.interp(q[1:], GEL.depth, GEL.upper)) and upper[0] == 0
    assert GEL.bounds(0.05) == (-0.2, 0.2)


def test_it_is_a_value():
    assert pickle.loads(pickle.dumps(GEL)) == GEL == GEL.replace() != GEL.replace(upper=[0, 1, 0])
    assert repr(GEL).startswith("TableLaw(depth=(0.0, 0.01, 0.03), lower=")


@pytest.mark.parametrize("solver", ["exact", "paper"])
def test_a_proxy_slides_on_its_edges(solver):
    slope = pn.TableLaw([0, 30e-3], [0, -1.5], [0, 1.5])
    proxy = pn.Proxy1d(slope, pn.Coupling(400, 1), 1 / 1600, solver)
    ticks = proxy.run(np.concatenate([np.linspace(-1e-3, 20e-3, 800), np.linspace(20e-3, 0, 800)]))
    sliding_in = (ticks.phase == pn.Phase.sliding_in.value) & (ticks.depth > 0)
    assert sliding_in.sum() > 500 and np.allclose(ticks.force[sliding_in], -50 * ticks.depth[sliding_in])
    sliding_out = (ticks.phase == pn.Phase.sliding_out.value) & (ticks.depth > 0)
    assert sliding_out.sum() > 300 and np.allclose(ticks.force[sliding_out], 50 * ticks.depth[sliding_out])
    again = pickle.loads(pickle.dumps(proxy))
    assert again.step(0.01) == proxy.step(0.01)


def test_every_problem_of_a_table_is_told():
    with pytest.raises(pn.ConfigurationError) as caught:
        pn.TableLaw([0, 0, 0.1], [0, 0, -1], [0, 0, -1.5])
    assert [problem.path for problem in caught.value.problems] == ["depth[1]", "lower[2]"]
    with pytest.raises(pn.ConfigurationError, match="the lower edge resists insertion"):
        pn.TableLaw([0], [1], [1.2])
    with pytest.raises(pn.ConfigurationError, match="1 to 32 knots"):
        pn.TableLaw(range(33), [0] * 33, range(33))
    with pytest.raises(pn.ConfigurationError, match="one number a knot"):
        pn.TableLaw([0, 1], [0], [0, 0])

"""The core's force along a trace against its own proxies, and its derivatives against central differences."""

import threading

import numpy as np
import punctura as pn
import pytest
from punctura import ConfigurationError
from punctura._core import TraceModel
from traces import MEMBRANE, NEEDLE, RATE, force_of, motion


def row(**values):
    return [values.get(name, getattr(pn.Tissue(), name, 0.0)) for name in TraceModel.membrane_names]


K06 = row(
    surface=5e-3, **{name: getattr(MEMBRANE, name) for name in ("stiffness", "precompression", "friction", "thickness")}
)
TAIL = {"tip_length": 2e-3, "growth": 400.0, "tail_length": 0.8e-3, "tail_floor": 0.6}
TISSUE = row(
    surface=8e-3, stiffness=300, precompression=0.1, friction=0.3, thickness=1e-3, cutting=0.3, set=0.2, **TAIL
)
COUPLING = [1500, 0.5, 0, 1, 0, 1]


def test_it_gives_the_forces_of_the_proxies():
    time, depth = motion(times=2)
    force, jacobian = TraceModel(NEEDLE, depth, time).forces([K06], [4000, 1, 0, 1, 0, 1])
    np.testing.assert_allclose(force, force_of(depth), atol=1e-12)
    assert jacobian.shape == (len(depth), 17)


@pytest.mark.parametrize("membranes", [[K06], [TISSUE], [K06, TISSUE]], ids=["K06", "tissue", "both"])
def test_derivatives_are_exact(membranes):
    time, depth = motion(times=2, hold=0.2)
    model = TraceModel(NEEDLE, depth, time)
    coupling = np.array(COUPLING, float)
    given = np.concatenate((coupling, np.ravel(membranes)))
    _, jacobian = model.forces(membranes, coupling)

    def force(values):
        return model.forces(values[6:].reshape(-1, 11), values[:6], False)[0]

    for i, value in enumerate(given):
        if value == 0 or i in (3, 5) or (value == 1 and i >= 6):  # relaxation and tail are off
            continue
        step = 1e-6 * value
        ahead, behind = given.copy(), given.copy()
        ahead[i] += step
        behind[i] -= step
        difference = (force(ahead) - force(behind)) / (2 * step)
        error = np.abs(difference - jacobian[:, i]) / np.abs(difference).max()
        # A sample at a corner of the force, such as the pop, has two derivatives.
        assert np.quantile(error, 0.97) < 2e-6, i


def test_a_sample_with_a_pop_gets_the_mean_over_its_way_also_in_an_old_hole():
    k06 = {"surface": 5e-3, "stiffness": 600, "precompression": 0.1, "friction": 0.3, "thickness": 1e-4}
    wall, coupling, finer = row(cutting=0.5, set=0.6, **k06, **TAIL), [300, 0, 0, 1, 0, 10], 200
    _, depth = motion(deepest=22e-3, times=2, hold=0.1)
    time = np.arange((len(depth) - 1) * finer + 1) / finer
    fine, _ = TraceModel(NEEDLE, np.interp(time, np.arange(len(depth)), depth), time / RATE).forces(
        [wall], coupling, False
    )
    coarse, _ = TraceModel(NEEDLE, depth, np.arange(len(depth)) / RATE).forces([wall], coupling, False)
    half = finer // 2
    mean = [fine[max(k - half, 0) : k + half + 1].mean() for k in range(0, len(fine), finer)]
    pops = np.abs(np.diff(fine[::finer])) > 0.15  # both ways, and again in the hole
    assert pops.sum() == 4
    np.testing.assert_allclose(coarse, mean, atol=6e-3)


def test_many_threads_may_use_one_model():
    time, depth = motion()
    model = TraceModel(NEEDLE, depth, time)
    alone, _ = model.forces([TISSUE], COUPLING)
    found = []
    threads = [threading.Thread(target=lambda: found.append(model.forces([TISSUE], COUPLING)[0])) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 4 and all((force == alone).all() for force in found)


def test_parameters_out_of_range_are_refused_with_their_place():
    time, depth = motion()
    model = TraceModel(NEEDLE, depth, time)
    with pytest.raises(ConfigurationError, match=r"membrane\[1\].friction"):
        model.forces([K06, [0, 1, 0, 50, *K06[4:]]], COUPLING)
    with pytest.raises(ConfigurationError, match="coupling_stiffness"):
        model.forces([K06], [0, *COUPLING[1:]])
    with pytest.raises(ValueError, match="membranes must be"):
        model.forces([K06[:4]], COUPLING)
    with pytest.raises(ValueError, match="time must ascend"):
        TraceModel(pn.Needle(1e-3, 0.3), [0, 1, 2], [0, 1, 1])


def test_only_the_wanted_derivatives_are_computed_and_they_are_the_same():
    model = TraceModel(NEEDLE, np.linspace(0, 20e-3, 300))
    force, every = model.forces([K06, K06], [4000, 1, 0, 1, 0, 1])
    names = np.array([*TraceModel.coupling_names, *TraceModel.membrane_names, *TraceModel.membrane_names])
    for by in (["coupling_stiffness", "surface"], ["friction", *TraceModel.coupling_names, "set"]):
        same, some = model.forces([K06, K06], [4000, 1, 0, 1, 0, 1], by=by)
        wanted = np.isin(names, by)
        assert np.array_equal(same, force) and np.array_equal(some[:, wanted], every[:, wanted])
        assert not some[:, ~wanted].any() and every[:, ~wanted].any()
    with pytest.raises(ValueError, match="membrane_names"):
        model.forces([K06], [4000, 1, 0, 1, 0, 1], by=["softness"])


def test_the_place_of_a_pop_is_the_same_without_its_derivatives():
    places, rows = TraceModel.pop_depths(NEEDLE, [K06], [4000, 1, 0, 1, 0, 1])
    alone, none = TraceModel.pop_depths(NEEDLE, [K06], [4000, 1, 0, 1, 0, 1], jacobian=False)
    assert np.array_equal(places, alone) and rows.shape == (1, 17) and none.shape == (1, 0)

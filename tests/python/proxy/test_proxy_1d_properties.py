"""Properties of every law, coupling and motion in one dimension, for both solvers."""

import numpy as np
import punctura
import pytest
from oracles import cases, core, random_runs

SOLVERS = ("exact", "paper")


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_force_is_inside_the_band_where_the_band_was_taken(solver):
    """`depth` is q for exact and q* for paper. At a jump of a law of thickness 0 exact may stand between both sides."""
    r = random_runs.runs(31, cases.count(150), 150)
    for lane in range(r.p.shape[1]):
        law, proxy = core.law(r.parameters, lane), core.proxy_1d(r, lane, solver)
        f, depth = np.array([(proxy.step(p), proxy.depth) for p in r.p[:, lane].tolist()]).T
        beside = np.array([law.bounds(depth + side) for side in (-1e-17, 0, 1e-17)])
        lower, upper = beside[:, 0].min(axis=0), beside[:, 1].max(axis=0)
        if solver == "exact":
            lower, upper = np.where(abs(depth) < 1e-17, np.minimum(lower, 0), lower), np.maximum(upper, lower)
            upper = np.where(abs(depth) < 1e-17, np.maximum(upper, 0), upper)
        assert (f >= lower - 1e-11).all() and (f <= upper + 1e-11).all()


@pytest.mark.parametrize("solver", SOLVERS)
def test_outside_there_is_no_force(solver):
    r = random_runs.runs(32, cases.count(200), 100)
    for lane in range(r.p.shape[1]):
        proxy = core.proxy_1d(r, lane, solver)
        assert not proxy.run(-abs(r.p[:, lane]) - 1e-9).force.any()


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_needle_pulled_out_leaves_no_force_behind(solver):
    r = random_runs.runs(33, cases.count(200), 100)
    out = np.linspace(0, -1, 4000)
    for lane in range(r.p.shape[1]):
        proxy = core.proxy_1d(r, lane, solver)
        proxy.run(np.ascontiguousarray(r.p[:, lane]))
        assert proxy.run(out).force[-1] == 0


def test_a_device_at_rest_reaches_a_constant_force_and_a_constant_proxy():
    """The coupling's damper reduces the remaining motion by B/D per tick; then nothing moves. Exact solver."""
    r = random_runs.runs(34, cases.count(200), 100)
    for lane in range(r.p.shape[1]):
        proxy = core.proxy_1d(r, lane, "exact")
        proxy.run(np.ascontiguousarray(r.p[:, lane]))
        settle = int(40 / -np.log(r.coupling.B[lane] / r.coupling.D[lane])) if r.coupling.B[lane] else 2
        rest = float(r.p[-1, lane])
        # Below the gain of the slope a creeping needle settles more slowly still.
        proxy.run(np.full(100 * settle, rest))
        q = proxy.position
        f = proxy.run(np.full(500, rest)).force
        assert np.ptp(f) <= 1e-11
        assert abs(proxy.position - q) <= 1e-14


def test_a_held_needle_keeps_force_and_proxy_to_the_last_bit_once_it_sticks():
    """Stop inside with a force between the edges: f = K e and q stay, for both solvers."""
    for solver in SOLVERS:
        for lane, thickness in enumerate((1e-3, 4e-3)):
            law = punctura.ThickLaw(punctura.Needle(1.08e-3, 0.28), punctura.Membrane(570.0, 0.41, 0.2, thickness))
            proxy = punctura.Proxy1d(law, punctura.Coupling(400.0, 1.0), 1 / 1600, solver=solver)
            proxy.run(np.concatenate([np.linspace(-1e-3, 6e-3, 2000), np.linspace(6e-3, 5.6e-3, 200)]))
            proxy.run(np.full(400, 5.6e-3))
            assert proxy.phase == punctura.Phase.sticking, lane
            f, q = proxy.force, proxy.position
            held = proxy.run(np.full(1600, 5.6e-3)).force
            assert abs(held - f).max() <= 1e-15 and abs(proxy.position - q) <= 1e-17


def test_a_small_motion_inside_the_band_is_met_by_the_coupling_alone():
    """Sticking is elastic: q does not move, and the force is (21) with a fixed proxy."""
    law = punctura.ThickLaw(punctura.Needle(1.08e-3, 0.28), punctura.Membrane(570.0, 0.41, 0.2, 1e-3))
    K, B, T = 400.0, 1.0, 1 / 1600
    for solver in SOLVERS:
        proxy = punctura.Proxy1d(law, punctura.Coupling(K, B), T, solver=solver)
        proxy.run(np.concatenate([np.linspace(-1e-3, 7e-3, 3000), np.linspace(7e-3, 6.3e-3, 600)]))
        proxy.run(np.full(200, 6.3e-3))
        q, e = proxy.position, proxy.offset
        for k in range(300):
            p = 6.3e-3 + 2e-5 * np.sin(0.1 * k)
            f = proxy.step(p)
            assert proxy.phase == punctura.Phase.sticking
            assert abs(proxy.position - q) <= 1e-16
            assert f == pytest.approx(K * (q - p) + B * (q - p - e) / T, abs=1e-11)
            e = q - p

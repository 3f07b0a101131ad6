"""Both solvers in one dimension: "exact" solves (21)-(23), "paper" (33), and both relax the coupling."""

from dataclasses import replace

import numpy as np
import punctura
import pytest
from oracles import cases, core, exact_residual, proxy_1d, random_laws, random_runs

TICKS = 200


@pytest.fixture(scope="module", params=list(cases.batches(1000, 500)))
def ticks(request):
    """Every tick of random runs, computed by the core."""
    seed, n = request.param
    r = random_runs.runs(seed, n, TICKS)
    return random_runs.ticks(r, *core.walk_1d(r, "exact"))


def test_every_tick_solves_21_to_23_to_1e_11_newtons_at_the_first_root(ticks):
    t = ticks
    r = exact_residual.residual(t.law, t.coupling, t.before.p, t.before.e, t.q_prev, t.p, t.e, t.q, t.f)
    assert abs(r.coupling).max() <= 1e-11
    assert abs(r.place).max() <= 1e-11
    assert r.friction.max() <= 1e-11
    assert r.earlier.max() <= 1e-11


def test_every_tick_from_the_same_state_finds_the_root_that_sampling_and_bisection_find(ticks):
    t = ticks
    mine = proxy_1d.exact(t.law, t.coupling, t.before, t.p)
    assert abs(mine - t.f).max() <= 1e-11


def test_with_couplings_far_beyond_any_device_the_residual_is_the_rounding_of_the_positions():
    """K to 1e6 N/m and B/T to 1000 K: the coupling turns one unit in the last place of p into g ulp(p) newtons, 1e-10 N
    and more, so no program in double can promise 1e-11 N there. It can promise a few such units.
    """
    r = random_runs.runs(9, cases.count(200), TICKS)
    rng = np.random.default_rng(9)
    n = r.p.shape[1]
    K, T = random_laws.log_uniform(rng, 1e4, 1e6, n), r.coupling.T
    r = replace(r, coupling=proxy_1d.Coupling(K, K * T * random_laws.log_uniform(rng, 10, 1000, n), T))
    t = random_runs.ticks(r, *core.walk_1d(r, "exact"))
    worst = exact_residual.residual(
        t.law, t.coupling, t.before.p, t.before.e, t.q_prev, t.p, t.e, t.q, t.f
    ).worst  # fmt: skip
    size = np.maximum.reduce([abs(t.p), abs(t.e), abs(t.before.p), abs(t.before.e)])
    assert (worst <= 1e-11 + 8 * t.coupling.g * np.spacing(size)).all()
    assert worst.max() > 1e-11 or n < 200


def test_a_proxy_that_is_held_does_not_move(ticks):
    t = ticks
    hold = proxy_1d.f_star(t.coupling, t.before, t.p)
    held = t.f == hold
    assert held.mean() > 0.1
    moved = abs(t.q - t.q_prev)[held]
    size = np.maximum.reduce([abs(t.p), abs(t.before.p), abs(t.e), abs(t.before.e)])[held]
    assert (moved <= 8 * np.spacing(size)).all()


def test_exact_is_the_default():
    r = random_runs.runs(3, 1, 100)
    c = punctura.Coupling(float(r.coupling.K[0]), float(r.coupling.B[0]))
    default = punctura.Proxy1d(core.law(r.parameters, 0), c, float(r.coupling.T[0]))
    p = np.ascontiguousarray(r.p[:, 0])
    assert np.array_equal(default.run(p), core.proxy_1d(r, 0, "exact").run(p))


@pytest.fixture(scope="module", params=list(cases.batches(1000, 500)))
def walked(request):
    """Random runs, and what the core found in them."""
    seed, n = request.param
    r = random_runs.runs(seed, n, TICKS)
    return r, core.walk_1d(r, "paper")


def test_every_tick_from_the_same_state_gives_the_force_of_33(walked):
    """q* is only known up to rounding. At a jump of a membrane of thickness 0, either side is a correct result."""
    r, found = walked
    t = random_runs.ticks(r, *found)
    assert abs(proxy_1d.paper_alternatives(t.law, t.coupling, t.before, t.p) - t.f).min(axis=0).max() <= 1e-10
    thick = t.law.H > 0
    assert abs(proxy_1d.paper(t.law, t.coupling, t.before, t.p) - t.f)[thick].max() <= 1e-10


def test_every_tick_relaxes_the_coupling_by_25(walked):
    r, found = walked
    t = random_runs.ticks(r, *found)
    assert (abs(proxy_1d.offset(t.coupling, t.before, t.f) - t.e) * t.coupling.K).max() <= 1e-12
    assert abs(t.q - (t.p + t.e)).max() <= 1e-16


def test_whole_runs_agree_wherever_rounding_alone_does_not_move_them(walked):
    """(33) is one step of a fixed-point iteration of gain |dPhi/dq| / g. Where the gain is too large it amplifies
    rounding tick by tick until it is as large as the force, and two correct programs part. The transcription in two
    float types shows where: as long as those agree to 1e-13 N, the core must agree with them to 1e-10 N; and where the
    recursion contracts, in every tick.
    """
    r, (f, _, _) = walked
    mine, e = proxy_1d.run(proxy_1d.paper, r.law, r.coupling, r.p)
    longer, _ = proxy_1d.run(
        proxy_1d.paper, r.parameters.law(np.longdouble), r.coupling.astype(np.longdouble), r.p.astype(np.longdouble)
    )
    t = random_runs.ticks(r, mine, e, r.p + e)
    at_a_jump = np.ptp(proxy_1d.paper_alternatives(t.law, t.coupling, t.before, t.p), axis=0) > 1e-10
    at_a_jump = np.maximum.accumulate(at_a_jump.reshape(mine.shape), axis=0)
    drift = np.maximum.accumulate(abs(mine - longer), axis=0)
    steady = (drift <= 1e-13) & ~at_a_jump
    assert abs(f - longer)[steady].max() <= 1e-10

    contracts = proxy_1d.contracts(r.law, r.coupling)
    assert (drift[-1, contracts] <= 1e-12).all()
    assert abs(f - longer)[:, contracts].max() <= 1e-10
    if steady.shape[1] >= 200:
        assert contracts.mean() > 0.3 and steady.mean() > 0.85, "the comparison must reach most of the ticks"


@pytest.mark.parametrize("solver", ["paper", "exact"])
def test_a_run_in_one_call_equals_the_same_run_tick_by_tick_and_goes_on_from_there(solver):
    r = random_runs.runs(2, 60, 120)
    f, e, _ = core.walk_1d(r, solver)
    for lane in range(60):
        proxy = core.proxy_1d(r, lane, solver)
        p = np.ascontiguousarray(r.p[:, lane])
        in_two = np.concatenate([proxy.run(p[:50]).force, proxy.run(p[50:]).force])
        assert np.array_equal(in_two, f[:, lane])
        assert proxy.offset == e[-1, lane] and proxy.force == f[-1, lane]
        proxy.reset()
        assert np.array_equal(proxy.run(p).force, f[:, lane])


def test_the_random_runs_meet_every_part_of_the_model():
    r = random_runs.runs(0, 1000, TICKS)
    f, e = proxy_1d.run(proxy_1d.paper, r.law, r.coupling, r.p)
    t = random_runs.ticks(r, f, e, r.p + e)
    hold = proxy_1d.f_star(t.coupling, t.before, t.p)
    touching = t.f != 0
    assert touching.mean() > 0.4
    for share in ((hold < t.f) & touching, (hold > t.f) & touching, hold == t.f):
        assert share.mean() > 0.05  # slides in, slides out, sticks
    assert (r.law.H == 0).any() and (r.law.H == 1e-5).any() and (r.law.A_O < 0).any()
    assert (r.coupling.B == 0).any() and (r.coupling.B > 0).any()
    assert 5 < abs(f).max() < 200

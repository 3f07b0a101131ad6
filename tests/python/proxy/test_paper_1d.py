"""Solver "paper" in one dimension against the transcription of K06 (33)."""

import numpy as np
import pytest
from oracles import cases, core, proxy_1d, random_runs

TICKS = 200


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


def test_a_run_in_one_call_equals_the_same_run_tick_by_tick_and_goes_on_from_there():
    r = random_runs.runs(2, 60, 120)
    f, e, _ = core.walk_1d(r, "paper")
    for lane in range(60):
        proxy = core.proxy_1d(r, lane, "paper")
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

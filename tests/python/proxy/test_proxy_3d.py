"""One membrane in space, both solvers: against the transcription of K06 (41), and against (35)-(38) with (23)."""

from functools import partial

import numpy as np
import punctura
import pytest
from oracles import cases, core, exact_residual, proxy_3d, random_scenes
from oracles.proxy_3d import dot

TICKS = 120
ENTERED = [punctura.Phase.sticking.value, punctura.Phase.sliding_in.value, punctura.Phase.sliding_out.value]


@pytest.fixture(scope="module", params=list(cases.batches(400, 400)))
def scenes(request):
    seed, n = request.param
    return random_scenes.scenes(seed, n, TICKS)  # about 1000 membranes


@pytest.fixture(scope="module", params=["paper", "exact"])
def walked(request, scenes):
    """(scenes, solver, results of the core, states before and after each tick by the oracle)."""
    solver = request.param
    found = core.walk_3d(scenes, solver)
    tick = partial(getattr(proxy_3d, solver), scenes.plane, scenes.law, scenes.coupling)
    s = proxy_3d.start(scenes.plane, scenes.p[0, scenes.scene])
    before, after = [], []
    for k, (p, axis) in enumerate(zip(*random_scenes.lane_motions(scenes), strict=True)):
        before.append(s)
        after.append(tick(s, p, axis))
        s = proxy_3d.observed(after[-1], found[0][k], found[1][k])
    return scenes, solver, found, before, after


def test_every_tick_from_the_same_state_gives_the_same_force(walked):
    _, _, (f, _, _, _), _, after = walked
    assert abs(np.array([s.f for s in after]) - f).max() <= 1e-10


def test_every_tick_agrees_on_what_is_outside_inside_or_barred(walked):
    _, _, (_, _, _, phase), _, after = walked
    assert np.array_equal(np.isin(phase, ENTERED), np.array([s.inside for s in after]))
    assert np.array_equal(phase == punctura.Phase.barred.value, np.array([s.barred for s in after]))


def test_every_tick_relaxes_the_coupling_and_keeps_the_proxy_on_its_line(walked):
    """(36), (34), and (35): the proxy moves along b only, while it is in the membrane."""
    s, _, (f, e, q, _), before, after = walked
    K, B, T, D = (v[:, None] for v in (s.coupling.K, s.coupling.B, s.coupling.T, s.coupling.D))
    for k, (was, now) in enumerate(zip(before, after, strict=True)):
        p = s.p[k, s.scene]
        assert (abs((B * was.e + T * f[k]) / D - e[k]) * K).max() <= 1e-12
        assert abs(q[k] - p - e[k]).max() <= 1e-16
        moved = q[k] - (was.p + was.e)
        across = moved - now.b * dot(now.b, moved)[:, None]
        assert abs(across[now.inside]).max(initial=0) <= 1e-15


@pytest.mark.parametrize("walked", ["exact"], indirect=True)
def test_exact_solves_23_along_the_needle_to_1e_11_newtons_at_the_first_root(walked):
    s, _, (f, e, q, _), before, after = walked
    worst = 0.0
    for k, (was, now) in enumerate(zip(before, after, strict=True)):
        m = np.flatnonzero(now.inside)
        if not len(m):
            continue
        n, a, b = s.plane.n[m], s.plane.a[m], now.b[m]
        cos_beta = dot(n, b)
        p, p_prev = s.p[k, s.scene[m]], was.p[m]

        # The plane through the membrane's point, seen along b: every vector becomes its coordinate on the needle.
        def depth(x, n=n, a=a, cos_beta=cos_beta):
            return dot(n, x - a) / cos_beta

        along = partial(lambda b, v: dot(b, v), b)
        q_now, q_prev = depth(q[k, m]), depth(p_prev + was.e[m])
        e_now, e_prev = along(e[k, m]), along(was.e[m])
        p_prev_b = q_prev - e_prev
        p_b = p_prev_b + along(p - p_prev)
        r = exact_residual.residual(
            s.law.lanes(m).with_cos_beta(cos_beta), s.coupling.lanes(m), p_prev_b, e_prev, q_prev, p_b, e_now, q_now,
            along(f[k, m]), size=np.maximum(abs(p).max(axis=1), abs(a).max(axis=1)) / cos_beta,
        )  # fmt: skip
        worst = max(worst, r.worst.max())
    assert worst <= 1e-11


def test_the_random_scenes_meet_every_phase_and_every_case_of_entry():
    scenes = random_scenes.scenes(0, 400, TICKS)
    p, axis = random_scenes.lane_motions(scenes)
    states = proxy_3d.run(proxy_3d.paper, scenes.plane, scenes.law, scenes.coupling, p, axis)
    inside, barred = np.array([s.inside for s in states]), np.array([s.barred for s in states])
    assert 0.2 < inside.mean() < 0.8 and 0.02 < barred.mean() < 0.4
    assert barred[0].any(), "starts inside"
    beta = np.rad2deg(np.arccos(np.clip(dot(scenes.plane.n[None], axis), -1, 1)))
    arrives = barred[1:] & ~barred[:-1]
    assert ((beta[1:] > 80) & (beta[1:] < 100) & arrives).any(), "grazes"
    assert ((beta[1:] > 140) & arrives).any(), "comes from behind"
    assert (beta[1:][inside[1:] & ~inside[:-1]] > 70).any(), "enters steeply"
    assert (inside[:-1] & ~inside[1:]).any(), "leaves"


def test_a_run_in_one_call_equals_the_same_run_tick_by_tick():
    s = random_scenes.scenes(5, 20, 80)
    for solver in ("exact", "paper"):
        f, e, _, _ = core.walk_3d(s, solver)
        for lane, scene in enumerate(s.scene):
            proxy = core.proxy_3d(s, lane, solver)
            p, axis = np.ascontiguousarray(s.p[:, scene]), np.ascontiguousarray(s.axis[:, scene])
            assert np.array_equal(
                np.concatenate([proxy.run(p[:30], axis[:30]).force, proxy.run(p[30:], axis[30:]).force]), f[:, lane]
            )
            assert np.array_equal(proxy.offset, e[-1, lane])
            proxy.reset()
            assert np.array_equal(proxy.run(p, axis).force, f[:, lane])

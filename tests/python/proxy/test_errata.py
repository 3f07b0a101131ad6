"""The errors in K06, each with a counterexample to the printed text. docs/errata.md names them."""

from dataclasses import replace

import numpy as np
import punctura
import pytest
from oracles import law, proxy_1d, proxy_3d, quadrature, random_laws, random_scenes
from oracles import law as printed

NEEDLE = punctura.Needle(1.08e-3, 0.28)
COUPLING = proxy_1d.Coupling(np.array([400.0]), np.array([1.0]), np.array([1 / 1600]))
SECTION_4 = dict(w=1.08e-3, theta=0.28, kappa=570.0, c=0.41, mu=0.2)
DOWN = np.array([0.0, -1.0, 0.0])


def as_printed(n, depths, H=1e-3):
    """b.f of (41) as printed, except L (read as H) and the missing middle case, for a stroke straight down (-y)."""
    L, c = law.law(**SECTION_4, H=H), COUPLING
    e, f, p_prev, along = np.zeros(3), np.zeros(3), depths[0] * DOWN, []
    for p in depths[:, None] * DOWN:
        q_star = p + (c.B * e + c.T * f) / c.D
        if n @ q_star >= 0:
            f = np.zeros(3)
        else:
            b = DOWN
            bent = replace(L, U=L.H / (n @ b))
            f_star = -c.g * (p - p_prev) + c.K * e
            s = np.array([n @ q_star / (n @ b)])
            lower, upper = (edge[0] for edge in law.band(bent, s))
            f_b = b @ f_star
            clamped = lower if f_b < lower else upper if f_b > upper else f_b
            f = f_star + b * (clamped - f_b)
        e, p_prev = (c.B * e + c.T * f) / c.D, p
        along.append(DOWN @ f)
    return np.array(along)


STROKE = np.linspace(-1e-3, 8e-3, 2000)


def mended(n, depths, H=1e-3):
    proxy = punctura.Proxy3d(
        NEEDLE, punctura.Membrane(570.0, 0.41, 0.2, H), [0, 0, 0], n, punctura.Coupling(400.0, 1.0), 1 / 1600, "paper"
    )
    return proxy.run(depths[:, None] * DOWN, DOWN).force @ DOWN


def test_e1_as_printed_with_the_inward_normal_a_needle_meets_no_force_at_all():
    assert abs(as_printed(DOWN, STROKE)).max() <= 1e-15
    assert mended(DOWN, STROKE).min() < -0.6


def test_e1_as_printed_with_the_normal_of_the_experiment_the_membrane_pulls_the_needle_in():
    """n = [0, 1, 0], entered downwards: n.b = -1, so U is negative and (18) changes its sign."""
    inside = as_printed(-DOWN, STROKE)[STROKE > 3e-3]
    assert (inside > 0.3).all()
    assert (mended(DOWN, STROKE)[STROKE > 3e-3] < -0.3).all()


def test_e2_an_ordinary_stroke_spends_ticks_in_the_case_that_41_leaves_out():
    """In, and half a millimetre back: f* lies inside the band, where (41) as printed gives the force no value."""
    depths = np.concatenate([STROKE, np.linspace(STROKE[-1], STROKE[-1] - 5e-4, 500)])
    L = law.law(**SECTION_4, H=1e-3)
    f, e = proxy_1d.run(proxy_1d.paper, L, COUPLING, depths[:, None])
    hold = [proxy_1d.f_star(COUPLING, proxy_1d.State(f[k - 1], e[k - 1], depths[k - 1]), depths[k])[0]
            for k in range(1, len(depths))]  # fmt: skip
    unnamed = (np.array(hold) == f[1:, 0]) & (f[1:, 0] != 0)
    assert unnamed.sum() > 400


def test_e5_the_explicit_euler_filter_overshoots_a_step_and_the_exact_one_does_not():
    turn = 2 * np.pi * 300 / 1600
    euler, exact = [0.0], [0.0]
    for _ in range(50):
        euler.append(euler[-1] + turn * (1 - euler[-1]))
        exact.append(exact[-1] + (1 - np.exp(-turn)) * (1 - exact[-1]))
    assert turn == pytest.approx(1.178, abs=1e-3)
    assert max(euler) == pytest.approx(1.178, abs=1e-3), "overshoots by 18 %"
    assert max(exact) <= 1 and (np.diff(exact) >= 0).all()


def roots(H, q0):
    """For each q0, how many depths about the pop solve g (q - q0) = Phi_I(q) with the numbers of section 4."""
    q = np.linspace(2e-3, 6e-3, 8001)
    lower, _ = law.band(law.law(**SECTION_4, H=H), q)
    sign = np.sign(COUPLING.g * (q - q0[:, None]) - lower)
    return (sign[:, 1:] != sign[:, :-1]).sum(axis=1)


def test_e8_29_has_three_solutions_at_the_pop_of_a_thin_membrane():
    """Where Phi_I rises faster than g, from (A_I (X + Q) - F) / H > g: below H = 0.163 mm with section 4's numbers."""
    L = law.law(**SECTION_4)
    assert (L.A_I * (L.X + L.Q) - L.F)[0] / COUPLING.g[0] == pytest.approx(0.163e-3, abs=1e-6)
    starts = np.linspace(L.X[0], L.X[0] + 6e-4, 121)
    assert roots(1e-4, starts).max() == 3
    assert roots(2e-4, starts).max() == 1


def test_e10_judged_with_the_force_of_the_last_tick_a_tip_enters_and_leaves_again_and_again():
    """(41) asks whether q*, which holds f(k-1), is outside. On the same motions the exact solver enters less than half
    as often; each entry reads b and U anew.
    """
    s = random_scenes.scenes(0, 60, 100)
    entries = {}
    for solver in ("paper", "exact"):
        tick = getattr(proxy_3d, solver)
        states = proxy_3d.run(tick, s.plane, s.law, s.coupling, *random_scenes.lane_motions(s))
        inside = np.array([state.inside for state in states])
        entries[solver] = (inside[1:] & ~inside[:-1]).sum()
    assert entries["paper"] > 2 * entries["exact"] > 0


def both(H):
    """(law, law by quadrature) of section 4's needle and membrane with thickness H."""
    return printed.law(**SECTION_4, H=H), printed.law(**SECTION_4, H=H, dtype=np.longdouble)


def test_e3_the_fifth_case_of_19_holds_with_q_minus_x_and_not_with_capital_q_minus_x():
    L, longer = both(1e-3)
    q = np.linspace(L.X[0] * 1.001, (L.X + L.U)[0], 20)  # U < X: the fifth case is [X, X + U]
    tail = L.A_O * (L.U + L.X - q) * (q - L.U + L.X + 2 * L.Q) / (2 * L.H)
    _, integral = quadrature.band(longer, q)
    assert abs(L.F * (q - L.X) / L.H + tail - integral).max() <= 1e-14
    as_printed = L.F * (L.Q - L.X) / L.H + tail
    assert abs(as_printed - integral).min() > 0.5, "half a newton and more, on a law that never exceeds 0.42 N"


def test_e3_the_fifth_case_of_19_holds_on_max_u_x_to_x_plus_u_and_not_on_x_to_u():
    """Printed [X, U] is the interval of the fourth case too, and leaves [max(U, X), X + U] without any."""
    L, longer = both(6e-3)  # U > X
    _, integral = quadrature.band(longer, (L.X + L.U) / 2)
    q = (L.X + L.U) / 2
    fourth = L.F * (q - L.X) / L.H + L.A_O * L.X * (L.X + 2 * L.Q) / (2 * L.H)
    fifth = L.F * (q - L.X) / L.H + L.A_O * (L.U + L.X - q) * (q - L.U + L.X + 2 * L.Q) / (2 * L.H)
    assert abs(fourth - integral) <= 1e-14
    assert abs(fifth - integral) > 5e-3


def test_e4_9_needs_mu_squared_to_be_the_sum_of_2_and_6():
    """f_rI + f_lI = -g [mu + (mu + t)/(1 - mu t)], which is (9) with 1 - mu^2; with 1 - mu it is 7 % off."""
    mu, t = 0.2, np.tan(0.28)
    total = mu + (mu + t) / (1 - mu * t)
    assert (2 * mu + (1 - mu**2) * t) / (1 - mu * t) == pytest.approx(total, rel=1e-15)
    assert (2 * mu + (1 - mu) * t) / (1 - mu * t) == pytest.approx(total, rel=0.07)
    assert (2 * mu + (1 - mu) * t) / (1 - mu * t) != pytest.approx(total, rel=0.06)


def test_e4_the_lower_edge_is_negative_inside_and_the_edges_meet_at_zero():
    """After (20): "Phi_I >= 0" is <= 0, and "Phi_I < Phi_O" holds only inside."""
    law = punctura.ThickLaw(punctura.Needle(1.08e-3, 0.28), punctura.Membrane(570.0, 0.41, 0.2, 1e-3))
    lower, upper = law.bounds(np.array([-1e-3, 0.0, 1e-6, 1e-3, 4e-3, 9e-3]))
    assert (lower[2:] < 0).all() and (lower[2:] < upper[2:]).all()
    assert not lower[:2].any() and not upper[:2].any()


def test_e9_the_limit_of_an_oblique_membrane_that_becomes_thin_is_phi_over_cos_beta():
    """(16), (17): with U = H / cos(beta), Phi(q) -> phi(q) / cos(beta) as H -> 0."""
    p = random_laws.parameters(13, 200)
    thin = printed.law(p.diameter, p.tip_angle, p.stiffness, p.precompression, p.friction)
    q = np.random.default_rng(13).choice([0.3, 0.7, 1.4], 200) * thin.X
    thin_lower, thin_upper = printed.thin(thin, q)
    H = 1e-9 * thin.X
    oblique = printed.law(
        p.diameter, p.tip_angle, p.stiffness, p.precompression, p.friction, H, p.obliquity, dtype=np.longdouble
    )
    lower, upper = quadrature.band(oblique, q)
    assert abs(lower * np.cos(p.obliquity) / thin_lower - 1).max() <= 1e-6
    close = abs(upper * np.cos(p.obliquity) - thin_upper) <= 1e-6 * thin.largest
    assert close.all()

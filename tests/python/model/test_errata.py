"""The errors in K06 section 2, each with a counterexample to the printed text. docs/errata.md names these tests."""

import numpy as np
import punctura
import pytest
from oracles import law as printed
from oracles import quadrature, random_laws

SECTION_4 = dict(w=1.08e-3, theta=0.28, kappa=570.0, c=0.41, mu=0.2)


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

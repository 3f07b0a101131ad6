"""K06 (18), (19) in the core, against quadrature of (16) and against the six printed cases."""

from fractions import Fraction

import numpy as np
import punctura
import pytest
from oracles import cases, core, quadrature, random_laws
from oracles import law as printed

DEPTHS = 40
column = np.s_[:, None]


@pytest.fixture(scope="module", params=list(cases.batches(10_000, 10_000)))
def laws(request):
    """(the law's lanes, depths, the core's lower and upper edge, quadrature's, its largest force)."""
    seed, n = request.param
    p = random_laws.parameters(seed, n, thinnest=1e-6)
    L, q = p.law(), random_laws.depths(seed, p.law(), DEPTHS)
    of_core = np.stack([core.law(p, lane).bounds(q[lane]) for lane in range(n)], axis=1)
    exact = np.stack(quadrature.band(p.law(np.longdouble).lanes(column), q))
    return L, q, of_core, exact, abs(exact).max(axis=(0, 2))


def test_the_thick_law_is_the_integral_of_the_thin_law_over_the_path(laws):
    _, _, of_core, exact, largest = laws
    assert (abs(of_core - exact) / largest[column]).max() <= 1e-11


def test_the_printed_six_cases_with_their_slips_mended_are_the_same_integral(laws):
    L, q, of_core, exact, largest = laws
    six = np.stack(printed.band(L.lanes(column), q))
    assert (abs(six - exact) / largest[column]).max() <= 1e-11
    assert (abs(six - of_core) / largest[column]).max() <= 1e-11


def test_the_random_laws_reach_every_corner_that_the_comparison_claims():
    p = random_laws.parameters(0, 10_000, thinnest=1e-6)
    L = p.law()
    assert p.thickness.min() < 1.1e-6 and p.thickness.max() > 1e-2
    assert np.rad2deg(p.obliquity).max() > 74.9 and (p.obliquity == 0).any()
    assert 0.3 < (L.A_O < 0).mean() < 0.8
    assert (p.friction * np.tan(p.tip_angle)).max() > 0.99
    assert p.tip_angle.max() > np.pi / 2 - 0.03
    assert 0.2 < (L.U < L.X).mean() < 0.9


def test_the_quadrature_is_right_to_rounding_by_exact_fractions():
    """(16) by hand in rational numbers, where nothing rounds: phi is piecewise linear, so its integral is exact."""
    p = random_laws.parameters(7, 60, thinnest=1e-6)
    L, q = p.law(np.longdouble), random_laws.depths(7, p.law(), 10)
    lower, upper = quadrature.band(L.lanes(column), q)

    def exactly(value):
        high = float(value)
        return Fraction(high) + Fraction(float(value - np.longdouble(high)))

    for i in range(60):
        X, A_I, A_O, Q, F, H, U = (exactly(getattr(L, k)[i]) for k in ("X", "A_I", "A_O", "Q", "F", "H", "U"))
        largest = max(abs(lower[i]).max(), abs(upper[i]).max())
        for j in range(10):
            end = Fraction(q[i, j])
            start = end - U
            low, high = (min(max(v, Fraction(0)), X) for v in (start, end))
            tip = (high**2 - low**2) / 2 + Q * (high - low)
            shaft = F * (max(end, X) - max(start, X))
            for got, want in ((lower[i, j], -(A_I * tip + shaft) / H), (upper[i, j], (A_O * tip + shaft) / H)):
                assert abs(exactly(got) - want) <= Fraction(1e-14) * exactly(largest)


def test_the_bounds_of_one_depth_are_the_bounds_of_an_array():
    p = random_laws.parameters(3, 50)
    q = random_laws.depths(3, p.law(), 20)
    for lane in range(50):
        the_law = core.law(p, lane)
        lower, upper = the_law.bounds(q[lane])
        for j in range(20):
            assert the_law.bounds(float(q[lane, j])) == (lower[j], upper[j])


@pytest.mark.parametrize("depth", [3, 1e-3, np.float64(1e-3), np.float32(1e-3), np.int64(2), np.array(1e-3)], ids=repr)
def test_one_depth_of_any_number_type_gives_two_plain_numbers(depth):
    law = punctura.ThinLaw(punctura.Needle(1.08e-3, 0.28), punctura.Membrane(570.0, 0.41, 0.2, 0.0))
    lower, upper = law.bounds(depth)
    assert type(lower) is type(upper) is float
    assert ([lower], [upper]) == tuple(edge.tolist() for edge in law.bounds([float(depth)]))

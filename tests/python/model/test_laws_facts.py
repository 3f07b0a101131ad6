"""K06's statements after (15) and (20) on every admissible law, and the reference numbers of its section 4."""

import math

import numpy as np
import punctura
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import core, random_laws

SECTION_4 = (punctura.Needle(1.08e-3, 0.28), dict(stiffness=570.0, precompression=0.41, friction=0.2))


def test_the_constants_of_section_4_have_the_reference_values_to_12_digits():
    needle, rest = SECTION_4
    for law in (
        punctura.ThinLaw(needle, punctura.Membrane(**rest, thickness=0.0)),
        punctura.ThickLaw(needle, punctura.Membrane(**rest, thickness=1e-4)),
    ):
        assert pytest.approx(3.7558120442572873e-3, rel=1e-12) == law.X
        assert pytest.approx(117.57056589624991, rel=1e-12) == law.A_I
        assert pytest.approx(19.210953071314766, rel=1e-12) == law.A_O
        assert pytest.approx(2.5014342724910454e-3, rel=1e-12) == law.Q
        assert pytest.approx(0.41024, rel=1e-12) == law.F
        assert pytest.approx(0.7357, abs=5e-5) == law.A_I * (law.X + law.Q)


@st.composite
def admissible(draw):
    """A needle and a membrane within K06 (7), of any obliquity to 75 degrees."""
    angle = draw(st.floats(0.02, math.pi / 2 - 0.02))
    friction = min(draw(st.floats(1e-3, 2.0)), draw(st.floats(0.01, 0.999)) / math.tan(angle))
    needle = punctura.Needle(draw(st.floats(1e-4, 5e-3)), angle)
    membrane = punctura.Membrane(
        stiffness=draw(st.floats(1.0, 1e5)), precompression=draw(st.floats(0.0, 20.0)), friction=friction,
        thickness=draw(st.floats(1e-6, 3e-2)),
    )  # fmt: skip
    return needle, membrane, draw(st.floats(0.0, math.radians(75)))


@given(admissible())
def test_insertion_resists_more_than_withdrawal_and_the_tip_more_than_the_shaft(case):
    """A_I > 0, A_O < A_I, A_I (X + Q) > F, A_O (X + Q) < F: K06 after (15)."""
    needle, membrane, obliquity = case
    for law in (punctura.ThinLaw(needle, membrane), punctura.ThickLaw(needle, membrane, obliquity)):
        assert law.A_I > 0
        assert law.A_O < law.A_I
        assert law.A_I * (law.X + law.Q) > law.F > law.A_O * (law.X + law.Q)


@given(admissible(), st.floats(1e-6, 1.5))
def test_the_lower_edge_is_never_positive_and_never_above_the_upper_edge(case, fraction):
    """Phi_I <= 0, Phi_I < Phi_O inside (E4: the printed "Phi_I >= 0" has its sign wrong), and no band outside."""
    needle, membrane, obliquity = case
    law = punctura.ThickLaw(needle, membrane, obliquity)
    lower, upper = law.bounds(fraction * (law.X + law.U))
    assert lower < 0 and lower < upper
    assert law.bounds(-fraction * law.X) == (0, 0)
    assert law.bounds(0.0) == (0, 0)


@given(admissible())
def test_behind_the_membrane_only_the_shaft_rubs_and_obliquity_lengthens_its_path(case):
    """E7: F U / H = F / cos(beta)."""
    needle, membrane, obliquity = case
    law = punctura.ThickLaw(needle, membrane, obliquity)
    lower, upper = law.bounds(1.5 * (law.X + law.U))
    grip = 2 * membrane.friction * (membrane.stiffness * needle.diameter + membrane.precompression)
    assert upper == pytest.approx(grip / math.cos(obliquity), rel=1e-8)
    assert lower == -upper


@given(admissible())
def test_the_withdrawal_edge_is_negative_in_the_tip_zone_exactly_when_friction_is_small(case):
    """A_O < 0 iff 2 mu < (1 - mu^2) tan(theta): then the membrane expels a needle let go."""
    needle, membrane, obliquity = case
    law = punctura.ThickLaw(needle, membrane, obliquity)
    margin = 2 * membrane.friction - (1 - membrane.friction**2) * math.tan(needle.tip_angle)
    if abs(margin) > 1e-9:
        assert (law.A_O > 0) == (margin > 0)
        assert (law.bounds(min(law.U, law.X) / 2)[1] > 0) == (margin > 0)


def test_the_band_has_no_jump_for_a_membrane_with_a_thickness():
    """Phi is an integral, so it is continuous: across a break it moves by no more than its steepest slope."""
    p = random_laws.parameters(5, 400)
    L = p.law()
    for lane in range(400):
        law, step = core.law(p, lane), 1e-9 * (L.X[lane] + L.U[lane])
        steepest = (L.A_I[lane] * (L.X[lane] + L.Q[lane]) + L.F[lane]) / L.H[lane]
        for depth in (0.0, L.U[lane], L.X[lane], L.X[lane] + L.U[lane]):
            before, after = (np.array(law.bounds(float(depth + side * step))) for side in (-1, 1))
            assert abs(after - before).max() <= 2 * step * steepest + 1e-10 * L.largest[lane]


@pytest.mark.parametrize("depth", [3, 1e-3, np.float64(1e-3), np.float32(1e-3), np.int64(2), np.array(1e-3)], ids=repr)
def test_one_depth_of_any_number_type_gives_two_plain_numbers(depth):
    law = punctura.ThinLaw(punctura.Needle(1.08e-3, 0.28), punctura.Membrane(570.0, 0.41, 0.2, 0.0))
    lower, upper = law.bounds(depth)
    assert type(lower) is type(upper) is float
    assert ([lower], [upper]) == tuple(edge.tolist() for edge in law.bounds([float(depth)]))

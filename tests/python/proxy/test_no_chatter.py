"""The force at a constant insertion speed: the exact one turns once, at the pop; the paper's form chatters."""

import numpy as np
import punctura
import pytest

NEEDLE = punctura.Needle(1.08e-3, 0.28)
COUPLING = punctura.Coupling(400.0, 1.0)
PERIOD = 1 / 1600
THICKNESSES = np.geomspace(1e-5, 4e-3, 27)
SPEEDS = np.geomspace(1e-3, 0.1, 9)


def turns(thickness, speed, solver, rate=1 / PERIOD):
    """How often the force changes between rising and falling on the way in."""
    membrane = punctura.Membrane(570.0, 0.41, 0.2, float(thickness))
    law = punctura.ThickLaw(NEEDLE, membrane) if thickness > 0 else punctura.ThinLaw(NEEDLE, membrane)
    way = law.X + thickness + 2e-3
    p = -2e-4 + np.arange(0, way, speed / rate)
    step = np.diff(punctura.Proxy1d(law, COUPLING, 1 / rate, solver=solver).run(p).force)
    way = np.sign(step[abs(step) > 1e-12])
    return int((way[1:] != way[:-1]).sum())


@pytest.mark.parametrize("thickness", [0.0, *THICKNESSES])
def test_the_exact_force_turns_at_most_once_at_any_speed(thickness):
    assert max(turns(thickness, v, "exact") for v in SPEEDS) <= 1


@pytest.mark.parametrize("rate", [500.0, 1000.0, 4000.0])
def test_the_exact_force_turns_at_most_once_at_other_rates(rate):
    for thickness in THICKNESSES[::4]:
        for speed in SPEEDS[::2]:
            assert turns(thickness, speed, "exact", rate) <= 1


def test_the_papers_force_alternates_hundreds_of_times_on_the_membrane_of_fig_10():
    """H = 0.1 mm at 1 and 5 mm/s, by about g v T a tick (1.2 and 6 mN): so the test above can fail."""
    assert turns(1e-4, 1e-3, "paper") > 1000
    assert turns(1e-4, 5e-3, "paper") > 200


def test_the_papers_force_alternates_below_the_thickness_that_its_recursion_predicts_and_not_above():
    """On a falling edge, Phi_I' = -G g, (33) without its limits is linear in (e, f) with a = B/D:

        f(k) = -G (g a e(k-1) + f(k-1)),   e(k) = a e(k-1) + f(k)/g

    Its eigenvalue passes -1 at G = (1 + a) / (1 + 2 a): at gain 1 without a damper, at 2/3 with a strong one. With the
    coupling of section 4 (a = 0.8, G = 0.69) and the steepest slope A_I (Q + H)/H that is H = 0.232 mm.
    """
    law = punctura.ThinLaw(NEEDLE, punctura.Membrane(570.0, 0.41, 0.2, 0.0))
    g, a = COUPLING.stiffness + COUPLING.damping / PERIOD, 0.8
    least = law.A_I * law.Q / (g * (1 + a) / (1 + 2 * a) - law.A_I)
    assert least == pytest.approx(0.232e-3, abs=1e-6)
    assert turns(0.95 * least, 1e-3, "paper") > 200
    assert turns(1.1 * least, 1e-3, "paper") <= 5
    assert max(turns(1.5 * least, v, "paper") for v in SPEEDS) <= 1


def test_the_force_at_the_pop_falls_from_the_peak_to_the_shaft_friction():
    """H = 0.1 mm, 5 mm/s: -0.7296 N to -0.4102 N, withdrawal +0.4102 N."""
    law = punctura.ThickLaw(NEEDLE, punctura.Membrane(570.0, 0.41, 0.2, 1e-4))
    proxy = punctura.Proxy1d(law, COUPLING, PERIOD)
    inwards = proxy.run(np.arange(-1e-3, 8e-3, 5e-3 * PERIOD)).force
    assert inwards.min() == pytest.approx(-0.7296, abs=2e-3)
    assert inwards[-1] == pytest.approx(-0.41024, abs=1e-9)
    outwards = proxy.run(np.arange(8e-3, 5e-3, -5e-3 * PERIOD)).force
    assert outwards[-1] == pytest.approx(0.41024, abs=1e-9)

"""Where the force of the paper's form chatters at a constant insertion speed."""

import numpy as np
import punctura
import pytest

NEEDLE = punctura.Needle(1.08e-3, 0.28)
COUPLING = punctura.Coupling(400.0, 1.0)
PERIOD = 1 / 1600
SPEEDS = np.geomspace(1e-3, 0.1, 9)


def turns(thickness, speed):
    """How often the force changes between rising and falling on the way in."""
    law = punctura.ThickLaw(NEEDLE, punctura.Membrane(570.0, 0.41, 0.2, float(thickness)))
    p = -2e-4 + np.arange(0, law.X + thickness + 2e-3, speed * PERIOD)
    step = np.diff(punctura.Proxy1d(law, COUPLING, PERIOD, solver="paper").run(p).force)
    way = np.sign(step[abs(step) > 1e-12])
    return int((way[1:] != way[:-1]).sum())


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
    assert turns(0.95 * least, 1e-3) > 200
    assert turns(1.1 * least, 1e-3) <= 5
    assert max(turns(1.5 * least, v) for v in SPEEDS) <= 1

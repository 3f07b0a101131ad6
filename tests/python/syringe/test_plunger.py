"""The plunger of a syringe, against a root search on its equations."""

import math

import numpy as np
import pytest
from punctura import ConfigurationError, Coupling, Phase
from punctura.syringe import Outlet, Plunger, Syringe, outlet_at, tube_resistance
from scipy.optimize import brentq

T, P_0, EASIER = 1 / 1600, 101325.0, 55.4
ML, KPA = 1e-6, 1e3


class Oracle:
    """One tick as its equations say, with Brent's method in place of the closed form. docs/syringe.md"""

    def __init__(self, s: Syringe, c: Coupling) -> None:
        self.s, self.K, self.B = s, c.stiffness, c.damping
        self.liquid, self.air, self.e, self.p = s.liquid, s.air, 0.0, None

    def contents(self, pressure, outlet):
        """(liquid, air) after a tick at this pressure."""
        flow = T / (self.s.resistance + outlet.resistance) * (pressure - outlet.pressure)
        if self.liquid > 0 or self.air == 0:
            return max(self.liquid - flow, 0.0), self.air
        if flow < 0:
            return -flow, self.air
        return 0.0, max(self.air - EASIER * flow * (P_0 + pressure) / P_0, 0.0)

    def pressure(self, volume, outlet, gives=0.0):
        """At which the contents fill the volume (m^3), which grows by C and `gives` (m^3/Pa) with the pressure."""

        def gap(pressure):
            liquid, air = self.contents(pressure, outlet)
            return liquid + air * P_0 / (P_0 + pressure) - volume - (self.s.compliance + gives) * pressure

        low, high = -P_0 * (1 - 1e-12), 1e3
        if gap(low) <= 0:
            return -P_0
        while gap(high) > 0:
            high *= 10
        return brentq(gap, low, high, xtol=1e-9, rtol=1e-14)

    def step(self, depth, outlet):
        if self.p is None:
            self.home = depth
        p = depth - self.home
        A, F, g = self.s.area, self.s.friction, self.K + self.B / T
        p_prev = p if self.p is None else self.p
        q_prev = p_prev + self.e
        f_star = self.K * (q_prev - p) + self.B * ((q_prev - p) - self.e) / T
        volume = self.s.liquid + self.s.air - A * q_prev
        P = self.pressure(volume, outlet)
        f = f_star
        for edge, slides in ((-F, f_star < -A * P - F), (F, f_star > -A * P + F)):
            if slides:
                # q = q_prev + (f - f*) / g, with f = -A P + edge
                P = self.pressure(volume - A * (edge - f_star) / g, outlet, gives=A * A / g)
                f = -A * P + edge
                break
        self.liquid, self.air = self.contents(P, outlet)
        self.e, self.p = q_prev + (f - f_star) / g - p, p
        return f, P


def thumb(rng, n, reach):
    """Depths (m): moves at constant speed, and rests."""
    x, path = 0.0, []
    while len(path) < n:
        goal, speed = rng.uniform(-0.3, 1.3) * reach, 10 ** rng.uniform(-3, -1)
        for _ in range(rng.integers(5, 60)):
            x += float(np.clip(goal - x, -speed * T, speed * T)) * (rng.random() < 0.9)
            path.append(x)
    return path[:n]


@pytest.mark.parametrize("kind", ["liquid", "air", "bubble"])
def test_each_tick_is_the_solution_of_the_equations(kind):
    rng = np.random.default_rng({"liquid": 1, "air": 2, "bubble": 3}[kind])
    for _ in range(8):
        liquid = 0.0 if kind == "air" else 10 ** rng.uniform(-1, 1) * ML
        air = 0.0 if kind == "liquid" else 10 ** rng.uniform(-1, 1) * ML
        s = Syringe(10 ** rng.uniform(-2.3, -1.5), liquid, air, rng.uniform(0, 3), 10 ** rng.uniform(-13, -11), 2e9)
        coupling = Coupling(10 ** rng.uniform(2.5, 3.5), rng.uniform(0, 3))
        plunger, oracle = Plunger(s, coupling, T), Oracle(s, coupling)
        outlet = Outlet(1e14, 0)
        for k, p in enumerate(thumb(rng, 300, (liquid + air) / s.area)):
            if k % 60 == 0:
                outlet = Outlet(10 ** rng.uniform(8, 14), rng.uniform(-5, 10) * KPA)
            f, pressure = oracle.step(p, outlet)
            assert plunger.step(p, outlet) == pytest.approx(f, abs=1e-5 * (1 + abs(f)))
            assert plunger.pressure == pytest.approx(pressure, abs=1e-5 * (P_0 + abs(pressure)))


def loss_of_resistance(s, resistance, pressure):
    """Force of the thumb (N) before and 1 s after the opening reaches this outlet; the thumb keeps its place."""
    plunger = Plunger(s, Coupling(2000, 2), T)
    for k in range(3200):
        before = plunger.step(min(3e-3, 2e-3 * k * T), Outlet(1e15, 8 * KPA))
    for _ in range(1600):
        after = plunger.step(3e-3, Outlet(resistance, pressure))
    return -before, -after, plunger.left


def test_the_thumb_feels_the_loss_of_resistance_with_liquid_and_with_a_bubble():
    for air in (0.0, 0.3 * ML):
        before, after, left = loss_of_resistance(Syringe(15e-3, 4 * ML, air, 0.5, 1e-12, 2e9), 5e8, 1 * KPA)
        assert before > 3
        assert after < 0.3 * before
        assert left > 0.1 * ML


def test_peek_changes_nothing_and_a_reset_fills_the_syringe():
    plunger = Plunger(Syringe(15e-3, 4 * ML, 0.3 * ML, 0.5, 1e-12, 2e9), Coupling(2000, 2), T)
    outlet = Outlet(1e11, 1 * KPA)
    for k in range(500):
        plunger.step(1e-5 * k, outlet)
    peeked = plunger.peek(5.1e-3, outlet)
    assert plunger.step(5.1e-3, outlet) == peeked
    plunger.reset()
    assert plunger.liquid == 4 * ML and plunger.phase == Phase.sticking and plunger.left == 0


@pytest.mark.parametrize(
    ("make", "path"),
    [
        (lambda: Syringe(-1, 1e-6, 0, 0, 1e-12, 1e9), "syringe.bore"),
        (lambda: Syringe(15e-3, 0, 0, 0, 1e-12, 1e9), "syringe"),
        (lambda: Syringe(15e-3, 1e-6, 0, 0, 0, 1e9), "syringe.compliance"),
        (lambda: Outlet(-1), "outlet.resistance"),
        (lambda: Outlet(1, -2e5), "outlet.pressure"),
        (lambda: Plunger(Syringe(15e-3, 1e-6, 0, 0, 1e-12, 1e9), Coupling(1, 1), 1600), "period"),
    ],
)
def test_an_invalid_value_is_named(make, path):
    with pytest.raises(ConfigurationError) as error:
        make()
    assert path in [problem.path for problem in error.value.problems]


def test_a_depth_that_is_no_number_changes_nothing():
    plunger = Plunger(Syringe(15e-3, 1e-6, 0, 0, 1e-12, 1e9), Coupling(1, 1), T)
    before = plunger.state
    with pytest.raises(ValueError, match="p must be"):
        plunger.step(math.nan, Outlet(0))
    assert plunger.state == before


def test_the_opening_between_two_layers_has_both_outlets():
    flavum, space, dura = Outlet(1e13, 8000), Outlet(1e10, 1000), Outlet(1e12, 2000)
    half = outlet_at([(5.5e-3, 4e-3, flavum, space), (-2e-3, 1e-3, dura, dura)], 3e-3)
    assert half.resistance == pytest.approx(1 / (0.5 / 1e13 + 0.5 / 1e10))
    assert outlet_at([], 3e-3).resistance < 1e7
    with pytest.raises(ValueError, match="length must"):
        outlet_at([], 0)


def test_a_cannula_of_17_gauge_has_the_resistance_of_hagen_and_poiseuille():
    assert tube_resistance(1.1e-3, 80e-3) == pytest.approx(128 * 1.002e-3 * 0.08 / (math.pi * 1.1e-3**4))

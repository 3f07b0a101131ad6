"""The plunger of a syringe from Python; tests/core/syringe has its equations."""

import math

import pytest
from punctura import ConfigurationError, Coupling, Phase
from punctura.syringe import Outlet, Plunger, Syringe, outlet_at, tube_resistance

T = 1 / 1600
ML, KPA = 1e-6, 1e3


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

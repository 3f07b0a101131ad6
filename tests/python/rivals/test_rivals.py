"""Rivals: fitted to traces of their own, compared, felt in a simulated hand."""

import json
import pickle
from dataclasses import replace

import numpy as np
import punctura as pn
import pytest
from punctura.identify.noise import effective_samples
from punctura.rivals import Layer, Rival, RivalInsertion, compare_trace, fit_rival, kinds, load_layers, save_layers
from punctura.rivals.chatter import places_of, rival_chatter
from punctura.rivals.first_stretch import compared, first_stretch, k06_on, rival_on
from punctura.rivals.layers import path_of
from punctura.rivals.problem import Problem
from punctura.rivals.starts import walls_of
from punctura.rivals.words import table
from punctura.trace import Trace, TraceError, segment
from punctura.trace.information import information

NOISE = 2e-3  # N
TRUE = {
    "okamura": {"linear": 30.0, "quadratic": 9e3, "puncture": 8e-3, "cutting": 0.1, "friction_slope": 20.0},
    "gordon": {"scale": 0.06, "growth": 330.0, "puncture": 8e-3, "friction": 0.2, "friction_slope": 12.0, "fall": 1e-3},
    "exponential": {"scale": 0.06, "growth": 330.0, "puncture": 8e-3, "friction": 0.2, "friction_slope": 12.0},
    "hunt_crossley": {"peak": 0.8, "exponent": 2.2, "puncture": 8e-3, "friction": 0.2, "friction_slope": 12.0},
    "kelvin_voigt": {"stiffness": 100.0, "puncture": 8e-3, "friction": 0.2, "friction_slope": 12.0},
    "mahvash_dupont": {"at_1_mm": 0.02, "exponent": 1.8, "ratio": 0.0, "puncture": 2.41e-3, "friction": 0.2},
}


def trace_of(name, numbers, seed=1, withdrawal=False, surface=2e-3):
    time = np.arange(0, 4.0, 0.01)
    depth = 4e-3 * time
    if withdrawal:
        depth = np.where(time < 2.5, 6.4e-3 * time, 16e-3 - 10e-3 * (time - 2.5))
    velocity = np.gradient(depth, time)
    force = Rival(name, numbers).resistance(depth - surface, velocity, 0.01)
    return Trace(depth, force + NOISE * np.random.default_rng(seed).standard_normal(len(time)), time, name)


@pytest.mark.parametrize("name", TRUE)
def test_a_fit_finds_the_rival_that_made_a_trace(name):
    fit = fit_rival(kinds()[name], trace_of(name, TRUE[name]))
    assert fit.rmse == pytest.approx(NOISE, rel=0.15)
    assert fit.converged
    numbers = fit.layers[0].rival.numbers
    for number, value in TRUE[name].items():
        if number == "puncture" and name != "mahvash_dupont":
            surface = fit.layers[0].surface
            assert numbers[number] + surface == pytest.approx(value + 2e-3, abs=0.05e-3)  # between two samples
    for number in ("friction_slope", "growth", "exponent"):
        if number in TRUE[name]:
            assert numbers[number] == pytest.approx(TRUE[name][number], rel=0.3)


def test_friction_outwards_is_fitted_only_with_a_withdrawal():
    with_out = TRUE["exponential"] | {"out_ratio": 0.6}
    both = fit_rival(kinds()["exponential"], trace_of("exponential", with_out, withdrawal=True))
    inwards = fit_rival(kinds()["exponential"], trace_of("exponential", with_out))
    assert both.parameters == inwards.parameters + 1
    assert both.layers[0].rival.numbers["out_ratio"] == pytest.approx(0.6, rel=0.05)


def test_a_first_insertion_that_does_not_reach_the_contact_has_walls_all_the_same():
    made = trace_of("exponential", TRUE["exponential"])
    short = np.concatenate([np.linspace(0, 5e-3, 60), np.linspace(5e-3, 0, 60)])  # nothing is there yet
    air = NOISE * np.random.default_rng(2).standard_normal(len(short))
    trace = Trace(np.concatenate([short, made.depth]), np.concatenate([air, made.force]))
    found = segment(trace)
    assert {stroke.insertion for stroke in found.strokes if stroke.end > found.contact} == {1}
    assert walls_of(trace, found)


def test_a_vector_moves_between_problems_that_fit_different_numbers():
    trace = trace_of("exponential", TRUE["exponential"], withdrawal=True)
    walls, path = walls_of(trace, segment(trace), one=False), path_of(trace, segment(trace))
    every = Problem(kinds()["exponential"], path, walls)
    few = Problem(kinds()["exponential"], replace(path, shows=frozenset({"insertion"})), walls)
    x = few.inside(1.1 * few.first)
    there = every.from_other(few, x)
    assert len(there) == len(x) + 1
    np.testing.assert_allclose(few.from_other(every, there), x, rtol=1e-12)


def test_the_comparison_puts_the_true_model_first():
    found = compare_trace(
        trace_of("exponential", TRUE["exponential"]), ["kelvin_voigt", "exponential", "sign_of_velocity"]
    )
    assert [row.name for row in found.rows] == ["exponential", "kelvin_voigt", "sign_of_velocity"]
    best, _, worst = found.rows
    assert best.held_out_rmse == pytest.approx(NOISE, rel=0.3)
    assert best.first_rmse_share < 0.01 < worst.first_rmse_share
    assert best.first_aic < worst.first_aic
    assert worst.chatter.rest > 0.1
    assert "exponential to puncture" in table(found).splitlines()[1]


def test_on_the_first_rise_a_curved_grip_follows_an_exponential_better_than_a_straight_one():
    made = trace_of("exponential", TRUE["exponential"])
    segments = segment(made)
    stretch = first_stretch(made, segments)
    contact, needle = float(made.depth[segments.contact]), pn.Needle(1.27e-3, 0.17)
    fits = {
        "curved": k06_on(stretch, needle, contact, True),
        "straight": k06_on(stretch, needle, contact, False),
        "exponential": rival_on(stretch, kinds()["exponential"]),
    }
    record = compared(fits, stretch)
    assert record["curved"].rmse_share < 0.3 * record["straight"].rmse_share
    assert record["curved"].aic < record["straight"].aic - 20
    assert record["exponential"].parameters == 3 and record["curved"].parameters <= 5
    assert record["exponential"].rmse_share < 0.01


def test_two_pops_get_two_layers():
    depth = np.linspace(0, 16e-3, 500)
    time = depth / 4e-3
    layers = [(1e-3, 0.8, 5e-3), (8e-3, 0.5, 4e-3)]
    force = NOISE * np.random.default_rng(2).standard_normal(500)
    for surface, peak, reach in layers:
        numbers = {"peak": peak, "exponent": 2, "puncture": reach, "friction": 0.15, "friction_slope": 0}
        force += Rival("hunt_crossley", numbers).resistance(depth - surface, np.full(500, 4e-3), np.gradient(time))
    fit = fit_rival(kinds()["hunt_crossley"], Trace(depth, force, time))
    assert len(fit.layers) == 2
    assert fit.rmse == pytest.approx(NOISE, rel=0.2)
    assert fit.layers[1].surface == pytest.approx(8e-3, abs=0.5e-3)


def test_information_counts_independent_samples():
    rng = np.random.default_rng(5)
    white = rng.standard_normal(4000)
    assert effective_samples(white) > 3000
    smooth = np.convolve(white, np.ones(20) / 20, "same")
    assert effective_samples(smooth) < 400
    few, many = information(white, 3, 100), information(white, 8, 100)
    assert many.bic - few.bic == pytest.approx(5 * np.log(100))
    assert many.aic - few.aic == pytest.approx(10 + 2 * 9 * 10 / 90 - 2 * 4 * 5 / 95)
    assert information(white, 100, 50).aic == np.inf
    with pytest.raises(ValueError, match="at least three"):
        information([1.0, np.nan, 2.0], 1, 3)


def test_a_rival_is_a_value_and_names_what_is_wrong():
    rival = Rival("dahl", {"friction": 0.7})
    assert pickle.loads(pickle.dumps(rival)) == rival
    assert hash(rival) == hash(Rival("dahl", {"friction": 0.7}))
    assert rival != Rival("dahl")
    with pytest.raises(pn.ConfigurationError, match=r"dahl.friction = -1.*between"):
        Rival("dahl", {"friction": -1})
    with pytest.raises(pn.ConfigurationError, match="not a parameter of this rival"):
        Rival("dahl", {"frictions": 1})
    with pytest.raises(pn.ConfigurationError, match="must be one of okamura"):
        Rival("okamura2004")
    with pytest.raises(ValueError, match="one for each of the 3 membranes"):
        RivalInsertion(pn.load_scene("venipuncture"), [rival, rival])


def test_the_sign_of_the_velocity_shakes_more_than_a_bristle():
    def shake(name):
        return rival_chatter((Layer(0.0, Rival(name)),), places_of(0.0, None, 10e-3))

    assert shake("sign_of_velocity").rest > 0.2
    assert shake("dahl").rest < 0.02


def test_the_command_line_compares_and_feels(punctura, tmp_path):
    trace = trace_of("exponential", TRUE["exponential"])
    csv = tmp_path / "trace.csv"
    rows = np.column_stack([trace.time, trace.depth * 1e3, trace.force])
    np.savetxt(csv, rows, delimiter=",", header="time_s,depth_mm,force_N", comments="")
    out = tmp_path / "fits"
    models = ["--models", "exponential,dahl", "--json", "--plot", tmp_path / "plot.svg"]
    record = json.loads(punctura("rivals", csv, *models, "--out", out).stdout)
    assert [model["name"] for model in record["models"]] == ["exponential", "dahl"]
    assert record["models"][0]["rmse_N"] == pytest.approx(NOISE, rel=0.15)
    drawing = (tmp_path / "plot.svg").read_text()
    assert drawing.startswith("<?xml") and "<dc:date>" not in drawing

    layers = load_layers(out / "exponential.json")
    depth = np.arange(-5e-3, 12e-3, 5e-6)
    ticks = pn.simulate("k06-fig10", depth, rivals=[layers[0].rival])
    numbers = layers[0].rival.numbers
    peak = numbers["scale"] * np.expm1(numbers["growth"] * numbers["puncture"])
    assert np.linalg.norm(ticks.force, axis=1).max() == pytest.approx(peak, rel=0.02)


def test_files_of_layers_are_checked(tmp_path):
    file = tmp_path / "one.json"
    layers = (Layer(1e-3, Rival("dahl")), Layer(3e-3, Rival("okamura", {"linear": 20.0})))
    save_layers(file, layers)
    assert load_layers(file) == layers
    good = json.loads(file.read_text())
    for text, why in {
        '{"format": "other"}': "is no file of punctura rivals --out",
        "x": "is no JSON",
        "[" * 100_000: "each layer needs",
        json.dumps(good | {"layers": [{"rival": "dahl"}]}): "each layer needs",
        json.dumps(good | {"layers": [{"surface_m": 0, "rival": "newton", "numbers": {}}]}): "must be one of",
    }.items():
        file.write_text(text)
        with pytest.raises(pn.ConfigurationError, match=why):
            load_layers(file)


def test_a_trace_without_a_force_is_refused():
    time = np.arange(0, 4.0, 0.01)
    with pytest.raises(TraceError, match="the force is 0 throughout"):
        compare_trace(Trace(4e-3 * time, np.zeros(len(time)), time, "of a wrong column"))

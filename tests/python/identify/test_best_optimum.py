"""An identification ends at the best optimum of its model, also where its first search ends at a lesser one."""

import runpy
import sys
from pathlib import Path

import numpy as np
import pytest
from punctura import Needle
from punctura._core import TraceModel
from punctura.identify import identify
from punctura.identify.fit import Fit, Misfit, fit
from punctura.identify.intervals import estimates
from punctura.identify.model import Model, extensions
from punctura.identify.moves import with_hops
from punctura.identify.parameters import COUPLING, MEMBRANE, Parameters, default_coupling, default_membrane
from punctura.identify.profile import BetterPoint
from punctura.identify.search import Search
from punctura.trace import Trace

TOOL = runpy.run_path(str(Path(__file__).parents[3] / "tools" / "try_intervals.py"))
STEP = "a better optimum"
NOISE = 4e-3


def rise(seed):
    """A trace that ends in the rise, and its needle: such a trace has several optima."""
    trace, needle, truth = TOOL["random_trace"](seed, TOOL["Conditions"](early=True))
    return TOOL["until_half"](trace, truth, needle), needle


@pytest.fixture
def one_start(monkeypatch):
    """The search begins at one place only, the least promising one, so that it ends at a lesser optimum."""
    every = Search.starts
    monkeypatch.setattr(Search, "starts", lambda *given: every(*given)[-1:])
    monkeypatch.setattr("punctura.identify.search.with_contacts_moved", lambda found: found)


@pytest.mark.parametrize("seed", [19, pytest.param(27, marks=pytest.mark.statistics)])
def test_the_intervals_lead_from_a_lesser_optimum_to_the_best_one(seed, one_start, monkeypatch):
    trace, needle = rise(seed)
    reports = []
    found = identify(trace, needle, 1, report=reports.append)
    assert STEP in reports
    monkeypatch.undo()
    best = identify(trace, needle, 1)
    assert found.fit.sse < best.fit.sse * (1 + 3 / len(trace))  # within three variances of a sample
    assert not any("better than the fit" in verdict for verdict in found.verdicts)


def test_the_report_says_where_there_may_be_still_better_optima(one_start, monkeypatch):
    monkeypatch.setattr(sys.modules["punctura.identify.identify"], "BETTER_OPTIMA", 0)
    reports = []
    found = identify(*rise(19), 1, report=reports.append)
    assert reports.count(STEP) == 0
    assert any("better than the fit" in verdict for verdict in found.verdicts)


def three_walls():
    """Three walls with a curved grip and a tail behind a spring that relaxes: in, a hold, out."""
    rng = np.random.default_rng(2)
    time = np.arange(0, 9.2, 1 / 60)
    depth = np.interp(time, [0, 2.6, 6.6, 9.2], np.array([0, 26e-3, 26e-3, 0]))
    rows = []
    for surface, stiffness, precompression, friction, thickness in (
        (4.5e-3, 220, 0.03, 0.1, 1.7e-3), (11.3e-3, 420, 0.25, 0.2, 0.8e-3), (16.2e-3, 150, 0.1, 0.15, 1.2e-3),
    ):  # fmt: skip
        values = {
            "surface": surface, "stiffness": stiffness, "precompression": precompression, "friction": friction,
            "thickness": thickness, "tail_length": 2e-3, "tail_floor": 0.3, "growth": 800.0, "tip_length": 3e-3,
        }  # fmt: skip
        row = default_membrane()
        for name, value in values.items():
            row[MEMBRANE.index(name)] = value
        rows.append(row)
    coupling = default_coupling(500)
    coupling[COUPLING.index("relaxation_1_stiffness")] = 250
    truth = Parameters(Needle(1.2e-3, 0.3), np.array(rows), coupling)
    force, _ = TraceModel(truth.needle, depth, time).forces(rows, coupling, False)
    return Trace(depth, np.asarray(force) + NOISE * rng.normal(size=len(depth)), time), truth


@pytest.mark.statistics
def test_hops_lead_from_a_lesser_optimum_of_three_walls_to_the_truth():
    trace, truth = three_walls()
    kinds = ("surface", "stiffness", "precompression", "friction", "thickness")
    walls = [f"membrane[{i}].{kind}" for i in range(3) for kind in kinds]
    names = [*walls, "coupling_stiffness", "relaxation_1_stiffness", "tissue.tip_length", "tissue.growth"]
    lesser = fit(Misfit(trace, truth), names, truth.with_values({"membrane[2].surface": 7e-3}))
    assert lesser.rmse > 4 * NOISE
    found = with_hops(lesser)
    assert found.rmse == pytest.approx(NOISE, rel=0.05)
    again = with_hops(lesser)
    np.testing.assert_array_equal(again.u, found.u)


def test_a_better_optimum_ends_the_search_for_intervals():
    trace, truth = three_walls()
    names = ["membrane[0].friction", "membrane[1].friction", "coupling_stiffness"]
    best = fit(Misfit(trace, truth), names, truth)
    poor = fit(best.misfit, names[:2], truth.with_values({"coupling_stiffness": 400.0}))
    u = best.free.coordinates(poor.parameters)
    lesser = Fit(best.misfit, best.free, u, poor.residuals, best.misfit.jacobian(best.free, u), poor.evaluations)
    with pytest.raises(BetterPoint) as met:
        estimates(lesser)
    assert np.sum((best.misfit.forces(met.value.parameters) - trace.force) ** 2) < poor.sse
    assert len(estimates(lesser, stops=False)) == 3


def test_a_search_that_takes_long_ends_and_says_so(monkeypatch):
    trace, needle = rise(27)
    trace = Trace(trace.depth, trace.force * (1 + 0.3 * np.sin(trace.depth / 2e-4)), trace.time)
    monkeypatch.setattr("punctura.identify.search.MOST_EVALUATIONS", 0)
    found = identify(trace, needle)
    assert [one.name for one in found.candidates] == ["K06"]
    assert any("ended before it had tried all" in verdict for verdict in found.verdicts)


@pytest.mark.parametrize("explains", [True, False])
def test_a_model_that_does_not_explain_the_trace_gets_no_full_search_for_its_bounds(explains, monkeypatch):
    trace, needle = rise(27)
    trace, steps = trace[::3], []
    monkeypatch.setattr("punctura.identify.intervals._searched_again", lambda *given: steps.append(1) or given[2])
    if not explains:
        wave = np.where(trace.force > 0.1, 0.2 * np.sin(trace.depth / 2e-4), 0.0)
        trace = Trace(trace.depth, trace.force + wave, trace.time)
    found = identify(trace, needle, 1)
    assert found.doubts.explained.ok == explains
    assert not all(one.identifiable for one in found.estimates)
    assert bool(steps) == explains


def test_an_extension_that_is_taken_out_is_off_and_takes_those_with_it_that_need_it():
    _, truth = three_walls()
    model = Model(3, extensions(truth.needle)[:6])
    assert model.words == ("curved grip", "tip length", "tail", "relaxation", "second relaxation", "set")
    relaxation = next(one for one in model.extensions if one.name == "relaxation")
    fewer = model.without(relaxation)
    assert fewer.words == ("curved grip", "tip length", "tail", "set")
    off = fewer.switched_off(truth)
    assert off.get("relaxation_1_stiffness") == 0 and off.get("tissue.growth") == 800
    plain = Model(3).switched_off(truth)
    assert (plain.get("tissue.growth"), plain.get("tissue.tail_floor"), plain.get("tissue.tip_length")) == (0, 1, 0)
    assert plain.get("membrane[1].stiffness") == truth.get("membrane[1].stiffness")

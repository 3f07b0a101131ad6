"""Two walls nearer than a tip length, whose first pop is only a kink: both are found, and named in order."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from punctura.identify import identify
from punctura.identify.choose import Choice
from punctura.identify.fit import Misfit, fit, in_order
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.trace import Trace

TOOL = runpy.run_path(str(Path(__file__).parents[3] / "tools" / "try_intervals.py"))
NOISE = 0.01


def overlapping(seed):
    return TOOL["random_trace"](seed, TOOL["Conditions"](noise=NOISE, walls=2, apart=0.5, rate=50))


@pytest.mark.parametrize("every", [pytest.param(1, marks=pytest.mark.statistics), 2])
def test_both_walls_are_found_whether_all_samples_are_used_or_half_of_them(every):
    trace, needle, truth = overlapping(2)
    found = identify(trace[::every], needle)
    assert len(found.parameters.membranes) == 2
    assert found.fit.rmse < 1.3 * NOISE
    assert any("the walls share one spring" in text for text in found.verdicts)
    assert any("pop within 3 samples" in text for text in found.verdicts) == (every == 2)  # fewer samples tell less
    for i in range(2):
        name = f"membrane[{i}].surface"
        assert found.parameters.get(name) == pytest.approx(truth[name], abs=0.3e-3)


def two_walls(*surfaces):
    rows = []
    for surface, stiffness in zip(surfaces, (400, 800), strict=True):
        row = default_membrane()
        row[:5] = [surface, stiffness, 0.3, 0.2, 0.3e-3]
        rows.append(row)
    return np.array(rows)


def test_a_fit_whose_walls_have_swapped_places_is_named_in_the_order_of_depth():
    _, needle, _ = overlapping(1)
    depth = np.linspace(0, 20e-3, 300)
    swapped = Parameters(needle, two_walls(6e-3, 3e-3), default_coupling(2000))
    trace = Trace(depth, Misfit(Trace(depth, depth), swapped).forces(swapped))
    names = [f"membrane[{i}].{kind}" for i in range(2) for kind in ("surface", "stiffness")]
    found = in_order(fit(Misfit(trace, swapped), names, swapped))
    assert found.parameters.get("membrane[0].surface") == pytest.approx(3e-3, abs=1e-5)
    assert found.parameters.get("membrane[0].stiffness") == pytest.approx(800, rel=1e-3)
    assert found.sse < 1e-12
    by_hand = np.zeros(len(found.u))
    by_hand[0] = 1e-7
    change = found.misfit.residuals(found.free, found.u + by_hand) - found.residuals
    assert change == pytest.approx(found.jacobian[:, 0] * 1e-7, abs=1e-5 * np.abs(change).max() + 1e-9)


def test_a_model_that_was_tried_and_is_better_than_the_last_one_is_chosen():
    class Found:
        effective = 1.0

        def __init__(self, bic):
            self.bic = bic

        def worth(self, _):
            return self

    last, best, other = Found(3.0), Found(1.0), Found(2.0)

    class Search:
        tried = (last, other, best)
        rule = type("Rule", (), {"prefers": staticmethod(lambda new, old: new.bic < old.bic)})

    assert Choice(Search, last, last, most=6)._best_of_all(last) is best

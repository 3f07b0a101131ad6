"""The least squares of every fit: as good as SciPy's, also at a bound."""

import numpy as np
import pytest
from punctura.identify import identify
from punctura.identify.fit import fit
from punctura.identify.least_squares import least_squares
from punctura.trace import TraceError
from scipy.optimize import least_squares as of_scipy
from traces import NEEDLE, trace

OPEN = np.full(2, np.inf)


def valley(at):
    """Rosenbrock's: a long, curved valley to (1, 1)."""
    return np.array([10 * (at[1] - at[0] ** 2), 1 - at[0]])


def along(at):
    return np.array([[-20 * at[0], 10.0], [-1.0, 0.0]])


@pytest.mark.parametrize(
    ("low", "high"), [(-OPEN, OPEN), ([-2, -2], [0.5, 2]), ([-2, 1.5], OPEN), ([-2, -np.inf], [2, 0])]
)
def test_a_search_ends_where_scipys_does_within_the_bounds(low, high):
    low, high = np.array(low, float), np.array(high, float)
    start = np.clip([-1.2, 1.0], low + 1e-3, high - 1e-3)
    found, count, ended = least_squares(valley, along, start, (low, high), 1e-9, 1e-9, 200)
    best = of_scipy(valley, start, along, (low, high), xtol=1e-12, ftol=1e-12)
    assert ended and count < 60
    assert (found >= low).all() and (found <= high).all()
    assert np.sum(valley(found) ** 2) == pytest.approx(2 * best.cost, abs=1e-6)


def test_a_search_says_that_it_did_not_end_and_keeps_the_best_point():
    found, count, ended = least_squares(valley, along, np.array([-1.2, 1.0]), (-OPEN, OPEN), 1e-9, 1e-9, 5)
    assert not ended and count == 5
    assert np.sum(valley(found) ** 2) < np.sum(valley(np.array([-1.2, 1.0])) ** 2)


def test_derivatives_that_overflow_end_the_search_where_it_is():
    start = np.array([0.0, 0.0])
    found, _, ended = least_squares(valley, lambda at: np.full((2, 2), np.nan), start, (-OPEN, OPEN), 1e-9, 1e-9, 50)
    assert not ended and (found == start).all()


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_residuals_that_overflow_end_the_search_where_it_is():
    start = np.array([1.0, 2.0])

    def residuals(at):
        assert np.isfinite(at).all()
        return np.array([1e200, -1e200])

    found, _, ended = least_squares(residuals, lambda at: 1e150 * np.eye(2), start, (-OPEN, OPEN), 1e-9, 1e-9, 50)
    assert not ended and (found == start).all()


def test_a_fit_that_ends_where_derivatives_overflow_is_an_error(monkeypatch):
    found = identify(trace(noise=0.01, seed=2), NEEDLE, membranes=1).fit
    monkeypatch.setattr(type(found.misfit), "jacobian", lambda *given: np.full(found.jacobian.shape, np.inf))
    with pytest.raises(TraceError, match="overflow where the fit ended"):
        fit(found.misfit, found.free.names, found.parameters)


def test_what_has_no_effect_stays():
    start = np.array([3.0, 4.0])
    found, count, ended = least_squares(lambda at: np.ones(3), lambda at: np.zeros((3, 2)), start, (-OPEN, OPEN), 1e-9,
                                        1e-9, 50)  # fmt: skip
    assert ended and count == 1 and (found == start).all()

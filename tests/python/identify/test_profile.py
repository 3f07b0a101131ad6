"""The profile of a parameter, also where the model overflows."""

import numpy as np
import pytest
from punctura.identify.fit import Misfit, fit
from punctura.identify.noise import effective_samples
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.identify.profile import bound
from punctura.identify.uncertainty import Uncertainty
from scipy.stats import f
from traces import NEEDLE, trace


def near_the_fit():
    row = default_membrane()
    row[:5] = [5e-3, 600, 0.3, 0.2, 0.5e-3]
    return Parameters(NEEDLE, np.array([row]), default_coupling(4000))


@pytest.mark.parametrize("wrong", [np.nan, np.inf])
def test_derivatives_that_overflow_far_from_the_fit_end_the_profile_there(monkeypatch, wrong):
    made, start = trace(noise=0.01), near_the_fit()
    names = ["membrane[0].surface", "tissue.stiffness", "coupling_stiffness", "offset"]
    uncertainty = Uncertainty(fit(Misfit(made, start), names, start))
    derivatives = Misfit.jacobian

    def overflows(self, free, u, blur=0):
        found = derivatives(self, free, u, blur)
        found[len(found) // 2 :, 2] = wrong
        return found

    monkeypatch.setattr(Misfit, "jacobian", overflows)
    low, high = bound(uncertainty, 1, -1), bound(uncertainty, 1, 1)
    assert low is not None and high is not None and low < uncertainty.fit.parameters.get("tissue.stiffness") < high


def test_an_interval_of_few_samples_is_as_wide_as_students_t():
    made, start = trace(noise=0.01)[::60], near_the_fit()
    uncertainty = Uncertainty(fit(Misfit(made, start), ["offset"], start))
    spare = effective_samples(uncertainty.fit.residuals, 1) - 1
    assert len(made) == 24 and 10 < spare < 24
    (value,), high = uncertainty.fit.free.values(uncertainty.fit.u), bound(uncertainty, 0, 1)
    assert (high - value) ** 2 / uncertainty.covariance[0, 0] == pytest.approx(f.ppf(0.95, 1, spare), rel=0.02)


def test_a_covariance_of_zero_has_no_profile_and_no_warning():
    start = near_the_fit()
    uncertainty = Uncertainty(fit(Misfit(trace(noise=0.01), start), ["tissue.stiffness", "offset"], start))
    uncertainty.covariance = np.diag([0.0, 4.0])  # as of a trace without noise
    with np.errstate(all="raise"):
        assert uncertainty.correlations == pytest.approx(np.diag([0.0, 1.0]))
        assert bound(uncertainty, 0, 1) is None

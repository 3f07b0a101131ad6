"""The profile of a parameter, also where the model overflows."""

import numpy as np
import pytest
from punctura.identify.fit import Misfit, fit
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.identify.profile import bound
from punctura.identify.uncertainty import Uncertainty
from traces import NEEDLE, trace


@pytest.mark.parametrize("wrong", [np.nan, np.inf])
def test_derivatives_that_overflow_far_from_the_fit_end_the_profile_there(monkeypatch, wrong):
    made = trace(noise=0.01)
    row = default_membrane()
    row[:5] = [5e-3, 600, 0.3, 0.2, 0.5e-3]
    start = Parameters(NEEDLE, np.array([row]), default_coupling(4000))
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

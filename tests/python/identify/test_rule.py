"""The rule that compares two models of a trace."""

import numpy as np
from punctura.identify.criteria import Candidate, Rule, candidate
from punctura.identify.fit import Misfit, fit
from punctura.identify.model import Model, extensions
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.trace import segment
from traces import MEMBRANE, NEEDLE, trace


def test_the_smaller_model_wins_a_tie_and_a_larger_one_must_predict_what_it_did_not_see(monkeypatch):
    made = trace(noise=0.01)
    rule = Rule(made, segment(made))
    small, large = Model(1), Model(1, (extensions(NEEDLE)[0],))
    row = default_membrane()
    row[:5] = [5e-3, MEMBRANE.stiffness, MEMBRANE.precompression, MEMBRANE.friction, MEMBRANE.thickness]
    start = Parameters(NEEDLE, np.array([row]), default_coupling(4000))
    one = candidate("K06", small, fit(Misfit(made, start), small.names, start))
    two = candidate("curved", large, fit(one.fit.misfit, large.names, large.start(one.fit.parameters, weak=True)))
    assert not rule.prefers(two, one) and rule.prefers(one, two)
    before = one.fit.misfit.evaluations
    assert rule.held_out_error(one) and one.fit.misfit.evaluations > before  # the folds count
    monkeypatch.setattr(Candidate, "worth", lambda self, effective: type("W", (), {"bic": -10.0 * len(self.fit.u)})())
    errors = {one: 1.0, two: 1.5}
    monkeypatch.setattr(Rule, "held_out_error", lambda self, c: errors[c])
    monkeypatch.setattr(Rule, "_may_be_slow_noise", lambda self, new, old: False)
    assert not rule.prefers(two, one)
    errors[two] = 1.0
    assert rule.prefers(two, one) and not rule.prefers(one, two)
    errors[two] = None
    assert not rule.prefers(two, one)

"""The noise of a fit: mixtures of white and slow noise, and what they do to intervals."""

from types import SimpleNamespace

import numpy as np
import punctura as pn
import pytest
from punctura.identify import identify, slow_noise
from punctura.identify.fit import Misfit, fit
from punctura.identify.intervals import estimates
from punctura.identify.noise import Mixture, NoiseOfFit
from punctura.identify.parameters import MEMBRANE as MEMBRANE_NAMES
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.identify.uncertainty import Uncertainty
from punctura.trace import Trace
from traces import NEEDLE, force_of, motion, trace


def matrix(mixture, n):
    lags = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    return mixture.share * np.exp(-lags / mixture.length) + (1 - mixture.share) * np.eye(n)


def wave_fit(noise):
    """Residuals of a wave fitted to noise, its Jacobian, and (J^T J)^-1."""
    at = 2 * np.pi * np.arange(len(noise)) / 60
    columns = np.column_stack((np.sin(at), np.cos(at)))
    inverse = np.linalg.inv(columns.T @ columns)
    return noise - columns @ (inverse @ (columns.T @ noise)), columns, inverse


@pytest.mark.parametrize("mixture", [Mixture(0.0, 1.0), Mixture(0.3, 40.0), Mixture(1.0, 7.0), Mixture(0.9, 2000.0)])
def test_a_mixture_is_its_correlation_matrix(mixture):
    columns = np.random.default_rng(1).normal(size=(150, 3))
    dense = matrix(mixture, 150)
    solved, log_det = mixture.solved(columns)
    np.testing.assert_allclose(dense @ solved, columns, atol=1e-9)
    assert log_det == pytest.approx(np.linalg.slogdet(dense)[1], abs=1e-8)
    np.testing.assert_allclose(mixture.smeared(columns), dense @ columns, atol=1e-10)


@pytest.mark.statistics
@pytest.mark.parametrize("mixture", [Mixture(0.0, 1.0), Mixture(1.0, 9.5), Mixture(0.5, 100.0), Mixture(0.9, 300.0)])
def test_the_told_spread_is_that_of_many_fits(mixture):
    n, rng = 600, np.random.default_rng(2)
    root = np.linalg.cholesky(matrix(mixture, n))
    made = [wave_fit(root @ rng.normal(size=n)) for _ in range(60)]
    true = made[0][2] @ made[0][1].T @ matrix(mixture, n) @ made[0][1] @ made[0][2]
    stated = np.median([np.diag(NoiseOfFit(left, columns).spread(inverse)) for left, columns, inverse in made], axis=0)
    assert stated / np.diag(true) == pytest.approx(np.ones(2), abs=0.3)


def test_a_parameter_that_leaves_no_trace_does_not_disturb_the_others():
    noise = np.random.default_rng(3).normal(size=300)
    left, columns, inverse = wave_fit(noise)
    blind = np.column_stack((columns, np.zeros(300)))
    stated = NoiseOfFit(left, blind).spread(np.pad(inverse, ((0, 1), (0, 1))))
    alone = NoiseOfFit(left, columns).spread(inverse)
    assert np.isfinite(stated).all() and stated[:2, :2] == pytest.approx(alone, rel=0.1, abs=1e-5)


def test_the_place_of_a_pop_between_two_samples_is_not_known():
    time, depth = motion(speed=20e-3)
    wall = pn.Membrane(600, 0.3, 0.2, 0.02e-3)
    made = Trace(depth, force_of(depth, 5.037e-3, wall) + 1e-3 * np.random.default_rng(1).normal(size=len(time)), time)
    row = default_membrane()
    row[:5] = [5.037e-3, 600, 0.3, 0.2, 0.02e-3]
    start = Parameters(NEEDLE, np.array([row]), default_coupling(4000))
    found = fit(Misfit(made, start), ["membrane[0].surface", "tissue.stiffness", "coupling_stiffness"], start)
    error = np.sqrt(Uncertainty(found).covariance[0, 0])  # of the depth where the wall pops
    assert error == pytest.approx(20e-3 / 200 / np.sqrt(12), rel=0.2)


def test_a_parameter_without_any_effect_is_not_identifiable():
    time, depth = motion(speed=20e-3)
    in_only = depth[: int(np.argmax(depth))]
    force = force_of(in_only) + 1e-3 * np.random.default_rng(1).normal(size=len(in_only))
    row = default_membrane()
    row[:5] = [5e-3, 600, 0.3, 0.2, 0.5e-3]
    row[MEMBRANE_NAMES.index("set")] = 0.1
    start = Parameters(NEEDLE, np.array([row]), default_coupling(4000))
    names = ["membrane[0].surface", "tissue.stiffness", "tissue.set", "coupling_stiffness"]
    made = Trace(in_only, force, time[: len(in_only)])
    found = {one.name: one.identifiable for one in estimates(fit(Misfit(made, start), names, start))}
    assert found == {name: name != "tissue.set" for name in names}


def test_the_noise_of_a_fit_is_computed_once(monkeypatch):
    plain, seen = NoiseOfFit.__init__, []

    def counted(self, residuals, jacobian):
        seen.append(residuals)
        plain(self, residuals, jacobian)

    monkeypatch.setattr(NoiseOfFit, "__init__", counted)
    identify(trace(noise=0.01)[::4], NEEDLE, membranes=1).as_dict()  # so short that the search uses all samples
    assert seen and len({id(residuals) for residuals in seen}) == len(seen)


@pytest.mark.parametrize(("left", "taken"), [(2.9, True), (3.1, False)])
def test_a_fit_that_leaves_far_more_than_without_slow_noise_is_not_taken(monkeypatch, left, taken):
    shown = SimpleNamespace(noise=SimpleNamespace(most_likely=lambda: (Mixture(0.5, 20.0), 1.0)))

    def fit_of(rmse):
        misfit = SimpleNamespace(whitening=None, whitened=lambda parameters, noise: misfit)
        return SimpleNamespace(
            rmse=rmse, measured=shown, misfit=misfit, parameters=None, free=SimpleNamespace(names=())
        )

    plain, likely = fit_of(1.0), fit_of(left)
    for name, change in (
        ("best_fit", lambda *_: likely),
        ("with_pops_moved", lambda fit: fit),
        ("in_order", lambda fit: fit),
    ):
        monkeypatch.setattr(slow_noise, name, change)
    air = SimpleNamespace(allows=lambda noise, variance: True)
    assert slow_noise.with_slow_noise(plain, air) is (likely if taken else plain)

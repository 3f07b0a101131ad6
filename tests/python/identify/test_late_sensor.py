"""A sensor whose force is late: a lag and a delay are found, taken into account, and said."""

import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import typer
from punctura import Needle
from punctura.cli._rig import rig_of
from punctura.errors import ConfigurationError
from punctura.identify import Parameters, Rig, identify
from punctura.identify.fit import Misfit
from punctura.identify.parameters import default_coupling, default_membrane
from punctura.trace import Trace

TOOL = runpy.run_path(str(Path(__file__).parents[3] / "tools" / "try_intervals.py"))
Conditions, random_trace = TOOL["Conditions"], TOOL["random_trace"]
LATE = 20e-3  # s


def of(found, name):
    return next(one for one in found.estimates if one.name == name)


def holds(found, name, value):
    return of(found, name).low <= value <= of(found, name).high


def test_a_late_model_whose_walls_the_needle_does_not_reach_has_no_derivatives_and_no_crash():
    trace, needle, _ = random_trace(4, Conditions(machine=True, lag=LATE))
    row = default_membrane()
    row[:5] = 1.0, 300.0, 0.1, 0.1, 1e-3
    far = Parameters(needle, np.array([row]), default_coupling(1000.0)).with_values({"lag": LATE})
    misfit = Misfit(trace, far)
    jacobian = misfit.jacobian(free := misfit.free(["membrane[0].stiffness", "lag"], far), free.coordinates(far))
    assert jacobian.shape == (len(trace), 2) and not jacobian.any()


@pytest.mark.parametrize(("kind", "machine"), [("lag", True), ("delay", False)])
def test_a_late_force_is_found_and_the_spring_is_held(kind, machine):
    trace, needle, truth = random_trace(4, Conditions(machine=machine, **{kind: LATE}))
    found = identify(trace, needle)
    assert len(found.parameters.membranes) == 1 and found.extensions == () and found.doubts.explained.ok
    assert holds(found, "coupling_stiffness", truth["coupling_stiffness"]) and holds(found, kind, LATE)
    spring = of(found, "coupling_stiffness")
    assert spring.high < 1.2 * spring.low
    (known,) = found.as_dict()["rig"]
    assert (known["name"], known["unit"], known["stated"]) == (kind, "s", False)
    assert known["value"] == pytest.approx(LATE, rel=0.1)
    (verdict,) = [one for one in found.verdicts if "comes late" in one]
    assert verdict.startswith("The measured force comes late") and f"--rig {kind}_ms=0" in verdict


def test_the_fine_steps_of_a_filter_alone_are_no_lag():
    """They follow a pop between two samples, which the model without a lag spreads over the sample."""
    row = default_membrane()
    row[:5] = 3.354e-3, 557.0, 0.593, 0.349, 0.212e-3
    true = Parameters(Needle(1.47e-3, 0.374), np.array([row]), default_coupling(2035.0)).with_values({"lag": 1e-6})
    time = np.linspace(0, 5, 250)
    depth = np.interp(time, [0, 2.3, 2.7, 5], [0, 14e-3, 14e-3, 0])
    force = Misfit(Trace(depth, depth, time), true).forces(true) + 0.01 * np.random.default_rng(2).normal(size=250)
    found = identify(Trace(depth, force, time), true.needle)
    assert found.rig == () and len(found.parameters.membranes) == 1


@pytest.mark.parametrize("seed", [10047, 10055, 10087])
def test_a_lag_that_a_soft_spring_hides_is_found(seed):
    """K06 alone leaves no more than noise, with a spring a third as stiff as the true one."""
    trace, needle, truth = random_trace(seed, Conditions(machine=True, lag=LATE))
    found = identify(trace, needle, 1)
    assert holds(found, "lag", LATE) and holds(found, "coupling_stiffness", truth["coupling_stiffness"])


def test_a_depth_that_is_late_is_a_negative_delay():
    trace, needle, truth = random_trace(4, Conditions(machine=True))
    late = Trace(np.interp(trace.time - LATE, trace.time, trace.depth), trace.force, trace.time)
    found = identify(late, needle, 1)
    assert holds(found, "delay", -LATE) and holds(found, "coupling_stiffness", truth["coupling_stiffness"])
    assert any(one.startswith("The measured depth comes late, by ") for one in found.verdicts)


@pytest.mark.parametrize("given", [Conditions(), Conditions(machine=True, rate=40)])
def test_a_prompt_sensor_is_not_called_late(given):
    for seed in (1, 2, 3):
        trace, needle, _ = random_trace(seed, given)
        found = identify(trace, needle)
        assert found.rig == () and found.parameters.late == (0.0, 0.0, 0.0, 0.0)
        assert not any("comes late" in one for one in found.verdicts)


def test_a_relaxation_is_no_lag():
    time = np.arange(0, 8, 0.01)
    depth = np.interp(time, [0.5, 3, 5, 7.5], [0, 7e-3, 7e-3, 0])
    _, needle, _ = random_trace(2, Conditions(machine=True))
    row = default_membrane()
    row[:5] = 2e-3, 600.0, 0.2, 0.2, 0.4e-3
    true = Parameters(needle, np.array([row]), default_coupling(3000.0))
    true = true.with_values({"relaxation_1_stiffness": 1200.0, "relaxation_1_time": 0.3})
    force = Misfit(Trace(depth, depth, time), true).forces(true)
    noise = 0.01 * np.random.default_rng(1).normal(size=len(time))
    found = identify(Trace(depth, force + noise, time), needle, 1)
    assert "relaxation" in found.extensions and found.rig == ()


def test_a_stated_lag_counts_and_its_tolerance_reaches_the_intervals():
    trace, needle, truth = random_trace(4, Conditions(machine=True, lag=LATE))
    sure, loose = (identify(trace, needle, 1, rig=Rig(lag=LATE, delay=0.0, lag_tolerance=more)) for more in (0, 5e-3))
    assert [str(one) for one in sure.rig] == ["lag 0.02 s, stated"]
    assert [one.name for one in loose.rig] == ["lag", "lag_tolerance"]
    assert "lag" not in [one.name for one in sure.estimates] and sure.parameters.late == (LATE, 0.0, 0.0, 0.0)
    assert holds(sure, "coupling_stiffness", truth["coupling_stiffness"])
    one, other = (of(found, "coupling_stiffness") for found in (sure, loose))
    assert other.value == one.value and other.high - other.low > 1.5 * (one.high - one.low)
    none = identify(trace, needle, 1, rig=Rig(lag=0.0, delay=0.0))
    assert none.rig == () and not holds(none, "coupling_stiffness", truth["coupling_stiffness"])


def test_without_time_a_stated_lag_is_not_used_and_this_is_said():
    trace, needle, _ = random_trace(4, Conditions(machine=True))
    found = identify(replace(trace, time=None), needle, 1, rig=Rig(lag=LATE))
    assert found.rig == () and any("not taken into account: the trace has no time" in one for one in found.verdicts)


@pytest.mark.parametrize("even", [True, False])
@pytest.mark.parametrize("late", [(0.0, 0.0), (8e-3, 0.0), (0.0, 4e-3), (8e-3, -4e-3)])
def test_the_derivatives_are_those_of_the_force(even, late):
    trace, needle, truth = random_trace(3, Conditions(machine=True, rate=100))
    if not even:
        trace = trace[np.sort(np.random.default_rng(1).choice(len(trace), 300, replace=False))]
    row = Parameters(needle, np.array([default_membrane()]), default_coupling(0.0))
    true = row.with_values(truth).with_values(dict(zip(("lag", "delay"), late, strict=True)))
    misfit = Misfit(trace, true)
    free = misfit.free([*truth, "offset", *(("lag", "delay") if any(late) else ())], true)
    u = free.coordinates(true)
    assert free.parameters(u).vector() == pytest.approx(true.vector(), rel=1e-9, abs=1e-12)
    jacobian = misfit.jacobian(free, u)
    for j, name in enumerate(free.names):
        if name == "lag" and late[0] == 0:
            continue  # its range ends here
        step = 1e-7 * max(abs(u[j]), 1e-2)
        ends = [misfit.residuals(free, u + sign * step * np.eye(len(u))[j]) for sign in (-1, 1)]
        slopes = (ends[1] - ends[0]) / (2 * step)
        assert np.max(np.abs(slopes - jacobian[:, j])) < 1e-4 * np.max(np.abs(slopes)), name


def test_the_filter_is_that_of_a_first_order_sensor():
    """A step of the force, where the needle rests behind a pop, comes as 1 - exp(-t / lag)."""
    time = np.arange(0, 1, 0.01)
    depth = np.where(time < 0.5, 0.0, 1e-3)
    row = default_membrane()
    row[:5] = -1e-3, 600.0, 0.2, 0.2, 0.4e-3
    _, needle, _ = random_trace(3, Conditions(machine=True))
    prompt = Parameters(needle, np.array([row]), default_coupling(3000.0))
    misfit = Misfit(Trace(depth, depth, time), prompt)
    force, late = misfit.forces(prompt), misfit.forces(prompt.with_values({"lag": 0.05}))
    left = (force[-1] - late[50:70]) / (force[-1] - force[0])
    assert left == pytest.approx(np.exp(-(time[50:70] - 0.49) / 0.05), rel=0.2)  # the step takes 10 ms
    assert left[1:] / left[:-1] == pytest.approx(np.exp(-0.01 / 0.05), rel=1e-6)


def test_the_option_states_a_lag_and_a_delay():
    rig, _ = rig_of(["lag_ms=20+-2", "delay_ms=-5"], "")
    assert (rig.lag, rig.delay) == pytest.approx((0.02, -5e-3)) and rig.lag_tolerance == pytest.approx(2e-3)
    for wrong in ("lag_ms=x", "lag_ms=20+-x", "lag_s=1", "depth_noise_um=10+-1"):
        with pytest.raises(typer.BadParameter, match="lag_ms=20"):
            rig_of([wrong], "")


def test_a_lag_that_cannot_be_is_named():
    trace, needle, _ = random_trace(4, Conditions(machine=True))
    for rig, name in (
        (Rig(lag=-1e-3), "rig.lag"),
        (Rig(delay=1.0), "rig.delay"),
        (Rig(lag_tolerance=1e-3), "rig.lag_tolerance"),
    ):
        with pytest.raises(ConfigurationError) as error:
            identify(trace, needle, 1, rig=rig)
        assert [problem.path for problem in error.value.problems] == [name]

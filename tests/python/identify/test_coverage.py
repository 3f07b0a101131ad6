"""How often the intervals of an identification hold the truth. `./test statistics` runs it."""

import runpy
from pathlib import Path

import pytest
from punctura.identify import identify
from scipy.stats import binom

TOOL = runpy.run_path(str(Path(__file__).parents[3] / "tools" / "try_intervals.py"))
tried, Conditions = TOOL["tried"], TOOL["Conditions"]

TRACES = 100
CHANCE = 1e-4  # that a correct program fails


SOME = 4  # traces, in every run of the tests


@pytest.mark.statistics
@pytest.mark.parametrize(
    ("given", "level"),  # docs/validation.md: with a strong drift, the interval of the surface is too narrow
    [
        (Conditions(), 0.93), (Conditions(correlation=0.5), 0.93), (Conditions(correlation=0.9), 0.93),
        (Conditions(drift=0.01), 0.93), (Conditions(drift=0.03), 0.85), (Conditions(rate=40), 0.93),
        (Conditions(machine=True, depth_noise=10e-6), 0.93), (Conditions(machine=True, tolerance=0.03), 0.93),
        (Conditions(machine=True, walk=0.03, auto=True), 0.85), (Conditions(machine=True, lag=0.02), 0.93),
        (Conditions(machine=True, delay=0.02), 0.93),
        (Conditions(machine=True, depth_step=10e-6, force_step=20e-3), 0.93),
        (Conditions(machine=True, noise=3e-3, force_step=20e-3), 0.9),
        (Conditions(machine=True, inward=True, auto=True), 0.93),
        (Conditions(machine=True, slide=0.08, presliding=20e-6), 0.93), (Conditions(machine=True, cable=15.0), 0.93),
        (Conditions(machine=True, walls=2, apart=0.5), 0.93), (Conditions(machine=True, walls=2, apart=1.3), 0.93),
    ],
)  # fmt: skip
def test_intervals_of_95_percent_hold_the_truth(given, level):
    rows = [row for seed in range(1, TRACES + 1) for row in tried(seed, given)]
    for kind in {row.kind for row in rows}:
        shown = [row for row in rows if row.kind == kind and row.identifiable]
        least = binom.ppf(CHANCE, len(shown), level)
        assert sum(row.held for row in shown) >= least, kind


@pytest.mark.statistics
def test_a_needle_that_is_stated_wrongly_is_named():
    given = Conditions(machine=True, auto=True, wrong=0.22)
    warned = [row.held for seed in range(1, TRACES + 1) for row in tried(seed, given) if row.kind == "warned"]
    assert sum(warned) >= 0.8 * TRACES


@pytest.mark.statistics
@pytest.mark.parametrize("slow", [{"drift": 0.1}, {"walk": 0.1}])
def test_a_trace_with_a_wall_that_is_slow_noise_is_not_called_explained(slow):
    given = Conditions(machine=True, auto=True, rate=50, **slow)
    rows = [row for seed in range(1, TRACES + 1) for row in tried(seed, given)]
    said = {kind: [row.held for row in rows if row.kind == kind] for kind in ("frank", "law")}
    assert said["frank"].count(False) <= binom.ppf(1 - CHANCE, TRACES, 0.005)
    assert said["law"].count(False) <= binom.ppf(1 - CHANCE, TRACES, 0.02)


@pytest.mark.statistics
def test_what_no_method_could_tell_is_never_called_identifiable():
    rows = [row for seed in range(1, TRACES + 1) for row in tried(seed, Conditions(early=True))]
    hidden = [row for row in rows if row.hidden]
    assert len(hidden) > 200
    assert not any(row.identifiable for row in hidden)


@pytest.mark.statistics
@pytest.mark.parametrize("given", [Conditions(drift=0.03), Conditions(machine=True, noise=3e-3, force_step=20e-3)])
def test_intervals_hold_the_truth_with_slow_noise_and_with_steps(given):
    rows = [row for seed in range(1, SOME + 1) for row in tried(seed, given)]
    shown = [row for row in rows if row.identifiable]
    assert len(shown) > 4 * SOME and sum(row.held for row in shown) >= len(shown) - 2


def test_two_explanations_of_a_rise_leave_its_spring_unknown():
    """A soft spring and no precompression, or a stiff spring and half of the grip as precompression: both fit."""
    trace, needle, truth = TOOL["random_trace"](9, Conditions(early=True))
    found = identify(TOOL["until_half"](trace, truth, needle), needle, membranes=1)
    known = {estimate.name for estimate in found.estimates if estimate.identifiable}
    assert known <= {"offset", "membrane[0].surface"}
    assert any("coupling_stiffness is not identifiable" in verdict for verdict in found.verdicts)

"""How often the intervals of an identification hold the truth. `./test statistics` runs it."""

import runpy
from pathlib import Path

import pytest
from scipy.stats import binom

tried = runpy.run_path(str(Path(__file__).parents[3] / "tools" / "try_intervals.py"))["tried"]

TRACES = 60
CHANCE = 1e-4  # that a correct program fails


@pytest.mark.statistics
@pytest.mark.parametrize(
    ("correlation", "level"),
    [(0.0, 0.93), (0.9, 0.85)],  # docs/validation.md: with correlated noise, intervals are too narrow
)
def test_intervals_of_95_percent_hold_the_truth(correlation, level):
    rows = [row for seed in range(1, TRACES + 1) for row in tried(seed, 0.01, correlation)]
    for kind in {row.kind for row in rows}:
        told = [row for row in rows if row.kind == kind and row.told]
        least = binom.ppf(CHANCE, len(told), level)
        assert sum(row.held for row in told) >= least, kind


@pytest.mark.statistics
def test_what_no_method_could_tell_is_never_called_identifiable():
    rows = [row for seed in range(1, 21) for row in tried(seed, 0.01, 0.0, early=True)]
    hidden = [row for row in rows if row.hidden]
    assert len(hidden) > 40
    assert not any(row.told for row in hidden)

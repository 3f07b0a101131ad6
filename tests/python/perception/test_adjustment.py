"""The method of adjustment: the settings of an observer, and what they cannot tell."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from protocols import ADJUST, written
from punctura.perception import Observer, Simulation, load_protocol
from punctura.perception.analysis import person
from punctura.perception.report import words


def test_an_adjustment_ends_where_both_intervals_seem_equal(tmp_path: Path) -> None:
    protocol = load_protocol(written(tmp_path, ADJUST))
    simulation = Simulation(protocol, Observer(weber=0.06))
    session = simulation.run(0, 3)
    found, settings = person(protocol, "", session), [line for line in session if line["answer"] == "equal"]
    levels = [float(str(line["level"])) for line in settings]
    assert found.trials == len(levels) == 12 and found.threshold is not None and found.jnd is not None
    starts = [session[0], *(line for before, line in pairwise(session) if before["answer"] == "equal")]
    assert sorted(float(str(line["level"])) for line in starts) == [0.14] * 6 + [0.68] * 6
    assert found.threshold.low < 0.41 < found.threshold.high and found.threshold.value == pytest.approx(np.mean(levels))
    assert found.jnd.low < found.jnd.value < found.jnd.high
    assert found.jnd.value == pytest.approx(0.67449 * np.std(levels, ddof=1), rel=1e-4)
    assert found.jnd.high / found.jnd.value == pytest.approx(np.sqrt(11 / 3.81575), rel=1e-4)  # chi square, 2.5 %


@pytest.mark.parametrize(("levels", "sd"), [(np.linspace(0.28, 0.32, 9), 0.04), (np.linspace(0.0, 0.6, 11), 0.02)])
def test_settings_that_the_levels_make_give_no_jnd(tmp_path: Path, levels: np.ndarray, sd: float) -> None:
    """20 settings at the level that is nearest to what a person wants; too few levels, and steps that are too wide."""
    loaded, random = load_protocol(written(tmp_path, ADJUST)), np.random.default_rng(1)
    protocol = replace(loaded, stimuli=tuple(replace(loaded.stimuli[0], level=float(level)) for level in levels))
    line = {"kind": "trial", "block": 0, "position": 1, "answer": "equal", "felt": []}
    for _ in range(20):
        wanted = random.normal(0.33 if sd < 0.03 else 0.3, sd, 20)
        nearest = levels[np.abs(levels[:, None] - wanted).argmin(axis=0)]
        found = person(protocol, "", [line | {"level": float(level)} for level in nearest])
        if sd > 0.03:
            assert found.jnd is None and found.reason == "settings reach the end of the levels: show more"
        else:
            assert found.jnd is not None and found.jnd.high > 0.67449 * sd
            assert words(found.jnd).startswith("at most 0.0") and words(found.threshold).startswith("0.3")

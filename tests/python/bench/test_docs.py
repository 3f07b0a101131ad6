"""The numbers of docs/passivity.md, without dry friction, and of docs/felt-force.md, on the simulated device."""

from pathlib import Path

import felt_force
import numpy as np
import pytest
from passivity import STEP, Case, Grip

# Where the line fit needs most, Hz. The tip oscillates there with a mass of (K + k) / w^2.
WORST = [("k06-fig10", 56), ("venipuncture", 47), ("epidural", 42)]


@pytest.mark.parametrize(("name", "frequency"), WORST)
def test_behind_a_line_fit_the_tip_rests_above_the_bound_and_oscillates_below(name, frequency):
    case = Case(name, "line_fit")
    grip = Grip((case.stiffness + 500) / (2 * np.pi * frequency) ** 2, 500)
    above, below = (case.speeds(share * case.bound, grip)[1] for share in (1.1, 0.9))
    assert above < 1e-4 and below > 5e-3  # m/s


@pytest.mark.parametrize("filter_name", ["none", "low_pass"])
def test_without_a_line_fit_a_tip_of_hardly_any_mass_oscillates_just_below_the_bound(filter_name):
    case = Case("k06-fig10", filter_name)
    above, below = (
        max(case.speeds(share * case.bound, Grip(1e-6, k))[1] for k in (100, 1000)) for share in (1.0, 0.93)
    )
    assert above < 1e-4 and below > 0.01


def test_the_dry_friction_of_one_step_on_all_couplings_ends_the_oscillation_below_the_bound():
    case = Case("venipuncture", "line_fit")
    assert case.fastest(0.5) > 20e-3
    assert case.fastest(0.5, friction=case.stiffness * STEP, step=STEP) == 0


ROOT = Path(__file__).resolve().parents[3]


def test_the_docs_have_the_measured_table_and_no_exercise_is_passed_on_a_loss_that_cannot_be_felt():
    runs = [
        felt_force.pushed(device, scale, speed)
        for device in felt_force.DEVICES
        for scale in felt_force.SCALES
        for speed in felt_force.SPEEDS
    ]
    assert felt_force.table(runs) in (ROOT / "docs" / "felt-force.md").read_text(encoding="utf-8")
    assert [run.loss.felt for run in runs] == [False] * 3 + [True] * 3 + [False] * 3 + [True] * 3
    assert all(run.cut_s == 0 for run in runs if run.loss.felt)

"""docs/felt-force.md shows the numbers that benchmarks/felt_force.py measures."""

from pathlib import Path

import felt_force

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

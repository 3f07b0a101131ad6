"""The results of benchmarks/conditioning.py: verdicts, printed text and files."""

import json

import conditioning
import pytest


def method(name="line_fit", **changes):
    rest = dict.fromkeys([*conditioning.DITHERS, "rest_all_along_N"], 0.010) | {
        "rest_across_N": 0.015, "rest_all_N": 0.02, "pop_error": 0.004, "frictionless_speed_m_per_s": 1e-3,
        "trembling_speed_m_per_s": 2e-3,
    }  # fmt: skip
    plain = {
        "name": name, "note": "a note", "added_delay_s": 1e-4, "slow_worst_N": 0.02, "loop_counts": 0.01,
        "stop_200_counts": 1.5, "creep_N": 0.03, "largest_stiffness_N_per_m": 800.0, "cost_ns": 100.0,
    }  # fmt: skip
    return (
        plain | {f"{solver}_{key}": value for solver in conditioning.SOLVERS for key, value in rest.items()} | changes
    )


def result(*methods):
    return {"compiler": "GNU 12", "flags": "-O2", "count_m": 5.5e-5, "methods": list(methods)}


@pytest.mark.parametrize(
    ("change", "missed"),
    [
        ({}, set()),
        ({"paper_rest_three_N": 0.017}, {"noise"}),
        ({"exact_rest_across_N": 0.023}, {"noise"}),
        ({"exact_rest_all_N": 0.03}, set()),
        ({"paper_pop_error": -0.021}, {"pop"}),
        ({"added_delay_s": 1e-3}, {"delay"}),
        ({"added_delay_s": -5e-3}, set()),
    ],
)
def test_each_demand_is_judged_over_both_solvers_and_every_dither(change, missed):
    verdict = conditioning.verdict(method(**change))
    assert {name for name, good in verdict._asdict().items() if not good} == missed


def test_the_table_has_a_row_and_a_note_for_each_method(capsys):
    assert conditioning.report(result(method("none", added_delay_s=0.002), method()), None, True) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[3:5]] == ["none", "line_fit"]
    assert lines[3].endswith("noise, pop") and lines[4].endswith("noise, pop, delay")
    assert lines[-1].endswith("a note")


def test_a_miss_of_the_chosen_method_fails_the_check_alone(tmp_path):
    missed = result(method(exact_rest_two_N=0.02))
    assert conditioning.report(missed, None, False) == 0
    assert conditioning.report(missed, tmp_path / "all.json", True) == 1
    written = json.loads((tmp_path / "all.json").read_text())
    assert written["meets"] == {"line_fit": {"noise": False, "pop": True, "delay": True}}
    assert written["methods"] == missed["methods"]

"""The results of ./bench: verdicts, printed text and files."""

import json
import subprocess
from pathlib import Path

import instructions
import numpy as np
import program
import pytest
import run
from numpy_loop import X, bounds, numpy_loop, python_loop
from pictures import draw
from program import ProgramError
from ratios import all_ratios
from table import SHARES


def timing(ns, over=None):
    times = {"median_ns": ns, "lower_quartile_ns": 0.9 * ns, "upper_quartile_ns": 1.2 * ns, "fastest_ns": 0.8 * ns}
    if over is not None:
        times["over_fused"] = {"median": over, "lower_quartile": 0.9 * over, "upper_quartile": 1.2 * over}
    return times


def measured(paper=1.4, exact=2.4, numpy=10_000.0, tissue=1.9):
    row = {"motion": "encoder", "membranes": 1, "repetitions": 21}
    contestants = {"fused": timing(10.0), "paper": timing(10 * paper, paper), "exact": timing(10 * exact, exact)}
    servo = {"paper": timing(60.0), "exact": timing(70.0)}
    slow = {"fused": timing(10.0), "paper": timing(90.0, 9.0), "exact": timing(90.0, 9.0)}
    return {
        "machine": {"processor": "one", "cores": 2, "load": 0.5, "system": "some"},
        "compiler": "GNU 12",
        "flags": "-O2",
        "ticks": 100,
        "versions": {"punctura": "0.1"},
        "work": [{"motion": "encoder", "membranes": 1} | dict.fromkeys(SHARES, 0.25)],
        "rows": [
            row | {"form": "1-D", "scalar": "double", "contestants": contestants},
            row | {"form": "1-D", "scalar": "double", "contestants": slow, "membranes": 8},
            row | {"form": "3-D", "scalar": "double", "contestants": slow},
            row | {"form": "servo step", "scalar": "double", "contestants": servo},
        ],
        "tissue": [
            {"form": "1-D", "motion": "encoder", "solver": "exact", "k06_ns": 10.0, "tissue_ns": 10 * tissue}
            | {"over_k06": {"median": tissue, "lower_quartile": 0.9 * tissue, "upper_quartile": 1.2 * tissue}}
        ],
        "loops": {"numpy": timing(numpy), "python": timing(2000.0)},
    }


def test_targets_are_for_one_membrane_in_one_dimension_only():
    ratios = all_ratios(measured())
    names = ["paper / fused", "exact / fused", "NumPy loop / paper", "NumPy loop / exact", "8 knots / K06"]
    assert [r.what.split(",")[0] for r in ratios] == names
    assert all(r.passes for r in ratios)


@pytest.mark.parametrize(
    ("measurement", "missed"),
    [
        ({"paper": 1.51}, "paper / fused"),
        ({"exact": 2.51}, "exact / fused"),
        ({"numpy": 7000.0}, "NumPy loop / exact"),
        ({"tissue": 2.01}, "8 knots / K06"),
        ({"paper": float("nan")}, "paper / fused"),
    ],
)
def test_a_miss_is_named_and_ends_a_check_with_1(measurement, missed, capsys):
    result = measured(**measurement)
    ratios = all_ratios(result)
    assert missed in [r.what.split(",")[0] for r in ratios if not r.passes]
    assert run.report(result, ratios, None, check=True) == 1
    assert f"MISS  {missed}" in capsys.readouterr().out
    assert run.report(result, ratios, None, check=False) == 0


def test_targets_met_end_a_check_with_0_and_are_printed_as_passed(capsys):
    result = measured()
    assert run.report(result, all_ratios(result), None, check=True) == 0
    printed = capsys.readouterr().out
    assert printed.count("PASS") == 5
    assert "MISS" not in printed


def test_the_json_file_holds_the_measurements_and_the_ratios(tmp_path):
    result = measured()
    run.report(result, all_ratios(result), tmp_path / "bench.json", check=False)
    written = json.loads((tmp_path / "bench.json").read_text())
    ratios = written.pop("ratios")
    assert written == result
    assert ratios[0] == {
        "what": "paper / fused, double, encoder motion",
        "value": 1.4,
        "lower_quartile": pytest.approx(1.26),
        "upper_quartile": pytest.approx(1.68),
        "target": "at most 1.5",
        "passes": True,
    }


def test_both_python_loops_give_the_same_forces_inside_the_band():
    t = np.arange(1500) / 1600
    depth = 4e-3 - 6e-3 * np.cos(9 * t)
    force = numpy_loop(depth)
    assert np.max(np.abs(force - python_loop(depth))) < 1e-12
    lower, upper = bounds(np.array([X + 1e-3]))
    assert np.max(force) == pytest.approx(upper[0])  # the whole shaft rubs: F
    assert np.min(force) < lower[0] < 0  # and before the pop, the tip does more


def test_the_loops_are_not_timed_when_they_disagree_with_the_paper_solver():
    depth = 4e-3 - 6e-3 * np.cos(9 * np.arange(300) / 1600)
    force = numpy_loop(depth)
    times = run.time_loops(depth, force, 300, 2)
    assert times["numpy"]["lower_quartile_ns"] <= times["numpy"]["median_ns"] <= times["numpy"]["upper_quartile_ns"]
    with pytest.raises(ProgramError, match="the numpy loop and the paper solver differ by 1e-09 N"):
        run.time_loops(depth, force + np.where(np.arange(300) == 150, 1e-9, 0), 300, 2)


def test_a_program_that_finds_its_contestants_unequal_ends_the_measurements(monkeypatch, tmp_path, capsys):
    def fails(command, **_):
        return subprocess.CompletedProcess(command, 3, "")

    monkeypatch.setattr(program.subprocess, "run", fails)
    with pytest.raises(ProgramError, match="ended with 3"):
        program.call(Path("bench_ticks"), 0.1, tmp_path / "dump")
    monkeypatch.setattr(run, "build", lambda folder: Path("bench_ticks"))
    assert run.main([]) == 3
    assert "ended with 3" in capsys.readouterr().err


def test_rows_of_many_trials_are_printed_and_drawn_with_their_ratios(capsys, tmp_path):
    row = {"scalar": timing(10.0) | {"times_faster": 1}, "avx2": timing(2.0) | {"times_faster": 5}}
    rows = [{"solver": "paper", "trials": 32, "ticks": 400, "contestants": row}]
    hands = [{"solver": "exact", "wall": "tissue", "contestants": row}]
    counts = [
        {"threads": n, "wall_ns": wall, "computed_ns": own} for n, wall, own in ((1, 100.0, 95.0), (2, 60.0, 100.0))
    ]
    threads = [{"what": "hand", "solver": "exact", "counts": counts}]
    growth = {"line": [[8, 4000, 6.0], [32, 4000, 0.9]], "membranes": [[1, 150.0], [8, 230.0]]}
    counts = {"paper": {"all": 27.0, "multiply": 9.0, "min_max": 2.0}}
    peak = {"operations": counts, "line_bytes": 16, "copied_bytes_per_ns": 20.0, "operations_per_ns": {"avx2": 30.0}}
    batch = {"rows": rows, "hands": hands, "threads": threads, "bytes_per_trial": 154}
    batch |= {"growth": growth, "peak": peak}
    result = measured() | {"batch": batch}
    run.report(result, all_ratios(result), None, check=False)
    printed = capsys.readouterr().out
    assert (
        "paper  avx2        32 trials   16.9 of  30.0 ( 56%);  10.0 of  20.0 ( 50%)" in printed
    )  # 27 operations in 1.6 ns
    assert "       8 x   4000    6.00" in printed
    draw(batch, tmp_path)
    assert {file.name for file in tmp_path.iterdir()} == {
        f"performance-{name}.svg" for name in ("faster", "roofline", "growth")
    }
    assert "proxies on a line, paper, 32 trials, 400 ticks" in printed and "a wall of tissue" in printed
    assert "hand  exact     2   60.00   1.67   1.90" in printed


def test_a_count_of_instructions_that_grew_by_more_than_2_percent_is_marked():
    lines, good = instructions.table(
        {"1-D paper": 102.1, "1-D exact": 101.0, "new": 3.0}, {"1-D paper": 100.0, "1-D exact": 100.0}
    )
    assert not good and [line.endswith("MORE") for line in lines] == [True, False, False]
    assert "no stored count" in lines[2]
    assert instructions.table({"1-D paper": 101.9}, {"1-D paper": 100.0})[1]

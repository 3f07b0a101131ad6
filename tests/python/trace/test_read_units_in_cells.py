"""Numbers with a unit in each cell, units in a column of their own, and clocks and forces that are too coarse."""

import json

import numpy as np
import pytest
from openpyxl import Workbook
from punctura.trace import TraceError, read_trace
from punctura.trace.steps import rounding
from traces import trace

MADE = trace()
ROWS = [tuple(map(float, row)) for row in zip(MADE.time, MADE.depth * 1e3, MADE.force, strict=True)]


def check(read, time=True):
    assert read.depth == pytest.approx(MADE.depth, abs=1e-8) and read.force == pytest.approx(MADE.force, abs=1e-5)
    assert (read.time == pytest.approx(MADE.time, abs=1e-6)) if time else read.time is None


def written(path, lines):
    path.write_text("\n".join(lines))
    return path


@pytest.mark.parametrize("comma", [False, True])
def test_a_unit_in_each_cell(tmp_path, comma):
    lines = ["time;depth;force", *(f"{t:.6f} s;{d:.6f}mm;{f:.6f} N" for t, d, f in ROWS)]
    check(read_trace(written(tmp_path / "a.csv", [line.replace(".", ",") if comma else line for line in lines])))
    held = {"time_s": [row[0] for row in ROWS], "depth": [f"{d:.6f} mm" for _, d, _ in ROWS],
            "force": [f"{f:.6f} N" for *_, f in ROWS]}  # fmt: skip
    (tmp_path / "a.json").write_text(json.dumps(held))
    check(read_trace(tmp_path / "a.json"))


def test_an_instrument_that_changes_its_range_changes_the_unit(tmp_path):
    cells = [f"{1e3 * f:.3f} mN" if abs(f) < 0.1 else f"{f:.6f} N" for *_, f in ROWS]
    assert {cell.split()[1] for cell in cells[:200]} == {"mN"} < {cell.split()[1] for cell in cells}
    lines = ["depth,force", *(f"{row[1]:.6f} mm,{cell}" for row, cell in zip(ROWS, cells, strict=True))]
    check(read_trace(written(tmp_path / "a.csv", lines)), time=False)
    lines[0] = "depth,force [N]"
    check(read_trace(written(tmp_path / "b.csv", lines)), time=False)


def test_units_in_a_column_of_their_own(tmp_path):
    """As a force gauge writes it: a report, rows with units and verdicts, and an empty last column."""
    above = ["Maximum,193.9,@,No.1047,,,,", "No.,Force,Unit,Displacement,Unit,Judge,Time,"]
    rows = [f"{i},{f:.6f},N,{d:.6f},mm,OK,10:30:{t:09.6f}," for i, (t, d, f) in enumerate(ROWS)]
    check(read_trace(written(tmp_path / "a.csv", above + rows)))
    check(read_trace(written(tmp_path / "b.txt", [f"{d:.6f} mm {f:.6f} N" for _, d, f in ROWS])), time=False)
    above = ["Force,Force Units,Displacement,Displacement Units,Time (s)"]
    check(read_trace(written(tmp_path / "d.csv", above + [f"{f:.6f},N,{d:.6f},mm,{t:.6f}" for t, d, f in ROWS])))
    book = Workbook()
    for row in [["Displacement", "Unit", "Force", "Unit"], *([d, "mm", f, "N"] for _, d, f in ROWS)]:
        book.active.append(row)
    book.save(tmp_path / "c.xlsx")
    check(read_trace(tmp_path / "c.xlsx"), time=False)


def test_letters_beside_numbers_need_not_be_their_unit(tmp_path):
    lines = ["depth,sex,force_N", *(f"{d:.6f},m,{f:.6f}" for _, d, f in ROWS)]
    with pytest.raises(TraceError, match="the unit of the depth column 'depth' is not stated"):
        read_trace(written(tmp_path / "a.csv", lines))
    frames = [f"{t:.6f},{d:.6f},ft,{f:.6f}" for t, d, f in ROWS]  # no names; ft is that of a sensor
    with pytest.raises(TraceError, match="no column is known to be the depth"):
        read_trace(written(tmp_path / "b.csv", frames), {"force": 4}, {"force": "N"})
    mixed = [f"{d:.6f},{'mm' if i < 900 else 'cm'},{f:.6f}" for i, (_, d, f) in enumerate(ROWS)]
    with pytest.raises(TraceError, match="the unit of the depth column 'depth' is not stated"):
        read_trace(written(tmp_path / "b.csv", ["depth,Unit,force_N", *mixed]))


def test_names_may_be_loads(tmp_path):
    lines = ["1 N,2 N", *(f"{d:.6f},{f:.6f}" for _, d, f in ROWS)]
    with pytest.raises(TraceError, match="The columns are '1 N', '2 N'"):
        read_trace(written(tmp_path / "a.csv", lines))


def test_a_clock_of_whole_seconds_is_no_time(tmp_path):
    lines = ["time,depth_mm,force_N", *(f"10:30:{int(t):02},{d:.6f},{f:.6f}" for t, d, f in ROWS)]
    read = read_trace(written(tmp_path / "a.csv", lines))
    check(read, time=False)
    [coarse] = [one for one in read.findings if one.kind == "time_repeats"]
    assert not coarse.severe and "the trace is read without time" in coarse.text
    [stated] = read_trace(tmp_path / "a.csv", {"time": "time"}).findings
    assert stated.severe and "are left out. Record a finer time" in stated.text


def in_kilonewtons(path, digits):
    lines = ["time_s,depth_mm,force_kN", *(f"{t:.6f},{d:.6f},{1e-3 * f:.{digits}f}" for t, d, f in ROWS)]
    return read_trace(written(path, lines))


def test_a_force_of_few_digits_is_named_with_its_step(tmp_path):
    fine = in_kilonewtons(tmp_path / "a.csv", 5)
    assert not fine.findings and rounding(fine.force) == pytest.approx(0.01 / np.sqrt(12), rel=1e-3)
    (finding,) = in_kilonewtons(tmp_path / "a.csv", 4).findings
    assert finding.kind == "coarse_force" and "in steps of 0.1 N" in finding.text and not finding.severe
    (finding,) = [one for one in in_kilonewtons(tmp_path / "a.csv", 3).findings if one.kind == "coarse_force"]
    assert finding.severe and "in steps of 1 N" in finding.text


def test_a_few_values_that_come_again_show_their_step():
    assert rounding(np.tile([0.0, 2.0, 4.0], 20)) == pytest.approx(2 / np.sqrt(12))
    assert rounding(np.zeros(30)) == rounding(np.array([0.0, 1.0, 3.3])) == 0.0

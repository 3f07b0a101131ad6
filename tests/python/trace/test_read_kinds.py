"""Workbooks with several sheets, JSON, ROS, and files without a depth."""

import json

import numpy as np
import pytest
from openpyxl import Workbook
from punctura.identify.folder import write_specimens
from punctura.trace import TraceError, read_trace
from punctura.trace.reading import Reading
from traces import trace

MADE = trace()
ROWS = [list(map(float, row)) for row in zip(MADE.time, MADE.depth * 1e3, MADE.force, strict=True)]


def check(read):
    assert read.depth == pytest.approx(MADE.depth, abs=1e-9) and read.force == pytest.approx(MADE.force, abs=1e-6)
    assert read.time == pytest.approx(MADE.time, abs=1e-6)


def workbook(path, specimens, beside=False):
    """As testXpert writes it: parameters, results, statistics, then a sheet for each specimen."""
    book = Workbook()
    book.active.title = "Paramètres"
    book.active.append(["Opérateur", None, "x"])
    for sheet in ("Résultats", "Statistiques"):
        book.create_sheet(sheet)
        results = [[name, name, 0.87 + 0.01 * i, 5.3] for i, name in enumerate("ABCDEF")]
        for row in ([None, "Désignation", "Fmax", "dL(Fmax)"], [None, None, "N", "mm"], *results):
            book[sheet].append(row)
    for name in specimens:
        book.create_sheet(name)
        for row in ([name] * 3, ["Temps d'essai", "Course standard", "Force standard"], ["s", "mm", "N"], *ROWS):
            book[name].append(row)
        for row in (2, 3, 4, 9, 2 * len(ROWS)) if beside else ():  # what a user has computed beside the numbers
            book[name].cell(row, 6, 20)
            book[name].cell(row, 7, 80)
    book.save(path)


def test_the_sheet_of_the_only_specimen_is_the_trace(tmp_path):
    for beside in (False, True):
        workbook(tmp_path / "a.xlsx", ["A"], beside)
        check(read_trace(tmp_path / "a.xlsx"))


def test_a_sheet_that_is_the_mean_of_the_specimens_is_no_specimen(tmp_path):
    workbook(tmp_path / "a.xlsx", ["A", "Éprouvette moyenne"])
    check(read_trace(tmp_path / "a.xlsx"))
    check(read_trace(tmp_path / "a.xlsx", sheet="Éprouvette moyenne"))


def test_one_of_several_specimens_is_chosen_or_all_are_a_folder(tmp_path):
    book = tmp_path / "a.xlsx"
    workbook(book, ["A/B".replace("/", " "), "C"])
    with pytest.raises(
        TraceError, match=r"2 tables can be the trace: 'A B', 'C'; .*--sheet NAME.*identify all of them"
    ):
        read_trace(book)
    check(read_trace(book, sheet="C"))
    check(read_trace(book, sheet="4"))
    with pytest.raises(TraceError, match="there is no sheet 'D'; the sheets are 'Paramètres', 'Résultats'"):
        read_trace(book, sheet="D")
    folder = tmp_path / "out" / "specimens"
    write_specimens(book, Reading(), folder)
    files = sorted(folder.iterdir())
    assert [file.name for file in files] == ["01-A B.parquet", "02-C.parquet"]
    for file in files:
        check(read_trace(file))
    times = [file.stat().st_mtime_ns for file in files]
    write_specimens(book, Reading(), folder)
    assert [file.stat().st_mtime_ns for file in files] == times
    write_specimens(book, Reading(sheet="C"), folder)
    assert [file.name for file in folder.iterdir()] == ["01-a.parquet"]


TIME, DEPTH, FORCE = ([row[i] for row in ROWS] for i in range(3))
JSON = {
    "columns": {"time_s": TIME, "depth_mm": DEPTH, "force_N": FORCE},
    "columns in an object": {"about": "x", "data": {"time_s": TIME, "depth_mm": DEPTH, "force_N": FORCE}},
    "units": {"units": {"time": "s", "depth": "mm", "force": "N"}, "time": TIME, "depth": DEPTH, "force": FORCE},
    "rows": [{"time_s": t, "depth_mm": d, "ft": {"force_N": f}} for t, d, f in ROWS],
    "rows in an object": {"about": "x", "samples": [{"time_s": t, "depth_mm": d, "force_N": f} for t, d, f in ROWS]},
    "as pandas splits it": {"columns": ["time_s", "depth_mm", "force_N"], "index": [0], "data": ROWS},
    "names and rows": {"about": "x", "columns": ["time_s", "depth_mm", "force_N"], "values": ROWS},
    "as pandas writes it": {
        name: {str(i): value for i, value in enumerate(column)}
        for name, column in (("time_s", TIME), ("depth_mm", DEPTH), ("force_N", FORCE))
    },
}


@pytest.mark.parametrize("what", JSON)
def test_json_is_read_as_columns_or_rows(tmp_path, what):
    (tmp_path / "a.json").write_text(json.dumps(JSON[what]))
    check(read_trace(tmp_path / "a.json"))


def test_json_lines_and_rows_without_names(tmp_path):
    (tmp_path / "a.jsonl").write_text("\n".join(map(json.dumps, JSON["rows"])))
    check(read_trace(tmp_path / "a.jsonl"))
    (tmp_path / "b.json").write_text(json.dumps(ROWS))
    check(
        read_trace(tmp_path / "b.json", {"time": 1, "depth": 2, "force": 3}, {"time": "s", "depth": "mm", "force": "N"})
    )
    (tmp_path / "c.json").write_text('{"time": [1, 2')
    with pytest.raises(TraceError, match="is no JSON: "):
        read_trace(tmp_path / "c.json")


def test_the_time_of_rostopic_is_in_nanoseconds_also_a_simulated_one(tmp_path):
    rows = [f"{round(1e9 * t)},{i},{f!r},{d!r}" for i, (t, d, f) in enumerate(ROWS)]
    (tmp_path / "a.csv").write_text("\n".join(["%time,field.header.seq,field.force.z,field.depth", *rows]))
    check(read_trace(tmp_path / "a.csv", {"depth": "field.depth"}, {"depth": "mm", "force": "N"}))


@pytest.mark.parametrize("names", ["header.stamp.sec,header.stamp.nanosec", "stamp.secs,stamp.nsecs"])
def test_a_stamp_of_seconds_and_nanoseconds_is_one_time(tmp_path, names):
    stamps = [divmod(round(1e9 * t) + 1_700_000_000_000_000_000, 10**9) for t, _, _ in ROWS]
    rows = [f"{whole},{rest},{f!r},{d!r}" for (whole, rest), (_, d, f) in zip(stamps, ROWS, strict=True)]
    (tmp_path / "a.csv").write_text("\n".join([f"{names},force_N,depth_mm", *rows]))
    check(read_trace(tmp_path / "a.csv"))


def test_a_stated_speed_gives_the_depth_and_a_turn_is_noticed(tmp_path):
    stops, turns = (float(MADE.time[i]) for i in np.flatnonzero(MADE.depth == MADE.depth.max())[[0, -1]])
    speed = float(MADE.depth.max() / stops)
    (tmp_path / "a.csv").write_text("\n".join(["time_s,force_N", *(f"{t},{f}" for t, _, f in ROWS)]))
    read = read_trace(tmp_path / "a.csv", speeds=[(0, speed), (stops, 0), (turns, -speed)])
    assert read.depth == pytest.approx(MADE.depth, abs=2e-5)
    assert read.findings[0].kind == "depth_from_speed" and "turned" not in read.findings[0].text
    [finding] = [
        one for one in read_trace(tmp_path / "a.csv", speeds=[(0, speed)]).findings if one.kind == "depth_from_speed"
    ]
    assert "as if the needle turned" in finding.text and "--speed-mm-per-s" in finding.text
    with pytest.raises(TraceError, match="without depth, state the needle's speed"):
        read_trace(tmp_path / "a.csv")
    (tmp_path / "b.csv").write_text("\n".join(["x,force_N", *(f"{t},{f}" for t, _, f in ROWS)]))
    with pytest.raises(TraceError, match="no column is known to be the time"):
        read_trace(tmp_path / "b.csv", speeds=[(0, speed)])


def test_depth_and_force_in_different_rows_are_joined(tmp_path):
    rows = [f"{t},{d},\n{t + 1e-3},,{f}" for t, d, f in ROWS]
    (tmp_path / "a.csv").write_text("\n".join(["time_s,depth_mm,force_N", *rows]))
    read = read_trace(tmp_path / "a.csv")
    assert [one.kind for one in read.findings if one.severe] == [] and len(read) == len(ROWS) - 1
    assert read.depth == pytest.approx(MADE.depth[:-1], abs=1e-4) and read.force == pytest.approx(MADE.force[:-1])
    assert read.findings[0].kind == "interpolated"


def test_depth_and_force_in_two_files_are_joined_on_their_clock(tmp_path):
    clock = 1_700_000_000
    (tmp_path / "f.csv").write_text("\n".join(["time_s,force_N", *(f"{clock + t:.3f},{f!r}" for t, _, f in ROWS)]))
    slower = ROWS[100::2]
    (tmp_path / "d.csv").write_text("\n".join(["t_ms,z_mm", *(f"{1e3 * (clock + t):.0f},{d!r}" for t, d, _ in slower)]))
    read = read_trace(tmp_path / "f.csv", depth_file=tmp_path / "d.csv")
    assert len(read) == len(ROWS) - 101 and read.depth == pytest.approx(MADE.depth[100:-1], abs=2e-5)
    assert read.force == pytest.approx(MADE.force[100:-1]) and read.time[0] == 0
    [finding] = read.findings
    assert finding.kind == "no_depth" and "101 of 1400 samples" in finding.text and not finding.severe
    (tmp_path / "d.csv").write_text("\n".join(["t_s,z_mm", *(f"{t},{d}" for t, d, _ in ROWS)]))
    with pytest.raises(TraceError, match=r"has no time in common with .*Use one clock for both"):
        read_trace(tmp_path / "f.csv", depth_file=tmp_path / "d.csv")
    with pytest.raises(TraceError, match="no column is known to be the depth"):
        read_trace(tmp_path / "f.csv", depth_file=tmp_path / "f.csv")

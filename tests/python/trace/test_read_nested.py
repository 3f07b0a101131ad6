"""JSON and MAT files that hold objects: several traces, parts of one, and what is no table."""

import json

import numpy as np
import pytest
from punctura.trace import TraceError, read_trace
from scipy.io import savemat
from traces import trace

MADE = trace()
TIME, DEPTH, FORCE = (list(map(float, column)) for column in (MADE.time, MADE.depth * 1e3, MADE.force))
FIRST = {"time_s": TIME, "depth_mm": DEPTH, "force_N": FORCE}
SECOND = {"time_s": TIME, "depth_mm": DEPTH, "force_N": [2 * force for force in FORCE]}


def written(path, held):
    path.write_text(json.dumps(held))
    return path


def check(read, factor=1):
    assert read.depth == pytest.approx(MADE.depth, abs=1e-9)
    assert read.force == pytest.approx(factor * MADE.force, abs=1e-6)
    assert read.time == pytest.approx(MADE.time, abs=1e-6)


@pytest.mark.parametrize(
    ("held", "names"),
    [
        ({"gel": FIRST, "liver": SECOND}, ["gel", "liver"]),
        ({"runs": {"gel": FIRST, "liver": SECOND}}, ["runs.gel", "runs.liver"]),
        ({"runs": [FIRST, SECOND]}, ["runs.1", "runs.2"]),
        ([FIRST, SECOND], ["1", "2"]),
    ],
)
def test_several_traces_in_a_file_are_never_one(tmp_path, held, names):
    path = written(tmp_path / "a.json", held)
    with pytest.raises(TraceError, match=f"2 tables can be the trace: '{names[0]}', '{names[1]}'.*--sheet NAME"):
        read_trace(path)
    check(read_trace(path, sheet=names[0]))
    check(read_trace(path, sheet="2"), 2)
    with pytest.raises(TraceError, match="there is no sheet 'lung'"):
        read_trace(path, sheet="lung")


def test_the_structures_of_a_mat_file_are_such_traces(tmp_path):
    savemat(tmp_path / "a.mat", {"gel": FIRST, "liver": SECOND})
    with pytest.raises(TraceError, match="2 tables can be the trace: 'gel', 'liver'"):
        read_trace(tmp_path / "a.mat")
    check(read_trace(tmp_path / "a.mat", sheet="liver"), 2)
    runs = np.zeros(2, [(name, object) for name in FIRST])
    for i, one in enumerate((FIRST, SECOND)):
        runs[i] = tuple(np.array(column) for column in one.values())
    savemat(tmp_path / "b.mat", {"run": runs})
    check(read_trace(tmp_path / "b.mat", sheet="run.2"), 2)


def test_depth_and_force_in_two_objects_are_one_trace(tmp_path):
    robot, sensor = {"time_s": TIME, "depth_mm": DEPTH}, {"time_s": TIME, "force_N": FORCE}
    check(read_trace(written(tmp_path / "a.json", {"robot": robot, "sensor": sensor})))


def test_the_object_that_has_the_stated_columns_is_the_trace(tmp_path):
    held = {"a": {"t": TIME, "p": DEPTH, "q": FORCE}, "b": {"t": TIME, "p": DEPTH, "r": FORCE}}
    path = written(tmp_path / "a.json", held)
    named, units = {"depth": "p", "force": "q", "time": "t"}, {"depth": "mm", "force": "N", "time": "s"}
    check(read_trace(path, named, units))


def test_units_beside_the_columns_or_around_them(tmp_path):
    columns = {"time": TIME, "depth": DEPTH, "force": FORCE}
    units = {"units": {"time": "s", "depth": "mm", "force": "N"}}
    check(read_trace(written(tmp_path / "a.json", {**units, "data": columns})))
    check(read_trace(written(tmp_path / "b.json", {"units": "SI", "data": columns | units})))
    each = {name: {"unit": units["units"][name], "values": values} for name, values in columns.items()}
    check(read_trace(written(tmp_path / "c.json", {"needle": {"unit": "mm", "diameter": 1.2}, "data": each})))


def test_rows_may_begin_with_their_names(tmp_path):
    rows = [list(FIRST), *map(list, zip(*FIRST.values(), strict=True))]
    check(read_trace(written(tmp_path / "a.json", rows)))


@pytest.mark.parametrize(
    "held",
    [
        {"columns": ["depth_mm", "force_N"], "data": [[1, 2], [1]]},
        [[1, 2], 3],
        [[1, 2], ["a", 2]],
        {"steps": ["in", "out"], "states": ["good", "good"]},
        {"depth_mm": [10**400] * 9, "force_N": [1] * 9},
        {"runs": [{}, {}]},
        "x",
    ],
)
def test_what_is_no_table_of_numbers_is_refused_with_a_sentence(tmp_path, held):
    with pytest.raises(TraceError, match=r"holds neither vectors of numbers|no column is known to be the depth"):
        read_trace(written(tmp_path / "a.json", held))

"""XLS files, HDF5 files, MAT files of version 7.3, and files with the ending of another kind."""

import sys

import h5py
import numpy as np
import pytest
import xlwt
from openpyxl import Workbook
from punctura.extras import MissingPackageError
from punctura.trace import TraceError, read_trace
from traces import trace

MADE = trace()
COLUMNS = {"time_s": MADE.time, "depth_mm": MADE.depth * 1e3, "force_N": MADE.force}
ROWS = np.column_stack(list(COLUMNS.values())).tolist()


def check(read):
    assert read.depth == pytest.approx(MADE.depth, abs=1e-9) and read.force == pytest.approx(MADE.force, abs=1e-9)
    assert read.time == pytest.approx(MADE.time, abs=1e-9)


def write_xls(path, sheets):
    book = xlwt.Workbook()
    for name in ("about", *sheets):
        sheet = book.add_sheet(name)
        for i, row in enumerate([["A report"], [], list(COLUMNS), *ROWS] if name in sheets else [["Operator", "x"]]):
            for j, cell in enumerate(row):
                sheet.write(i, j, cell)
    book.save(str(path))


def test_an_old_workbook_is_read_by_its_content(tmp_path):
    write_xls(tmp_path / "a.xls", ["A"])
    check(read_trace(tmp_path / "a.xls"))
    (tmp_path / "a.xls").rename(tmp_path / "a.txt")
    check(read_trace(tmp_path / "a.txt"))
    write_xls(tmp_path / "b.xls", ["A", "B"])
    with pytest.raises(TraceError, match="2 tables can be the trace: 'A', 'B'"):
        read_trace(tmp_path / "b.xls")
    check(read_trace(tmp_path / "b.xls", sheet="B"))


def test_a_new_workbook_may_have_the_old_ending(tmp_path):
    book = Workbook()
    for row in [list(COLUMNS), *ROWS]:
        book.active.append(row)
    book.save(tmp_path / "a.xls")
    check(read_trace(tmp_path / "a.xls"))
    (tmp_path / "b.xls").write_text("\n".join("\t".join(map(str, row)) for row in [list(COLUMNS), *ROWS]))
    check(read_trace(tmp_path / "b.xls"))  # a text with tabs, as many programs name it
    (tmp_path / "c.xls").write_text("<html><table><tr><td>1</td></tr></table></html>")
    with pytest.raises(TraceError, match=r"HTML or XML.*save it as XLSX or CSV"):
        read_trace(tmp_path / "c.xls")
    (tmp_path / "b.zip").write_bytes(b"PK\3\4" + bytes(600))
    with pytest.raises(TraceError, match="is no text, Parquet, MAT, XLSX or HDF5 file"):
        read_trace(tmp_path / "b.zip")


def test_an_hdf5_file_is_as_one_object_with_others_in_it(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        for name, values in COLUMNS.items():
            file.create_dataset(name, data=values, compression="gzip")
        file["about"] = "a text"
    check(read_trace(tmp_path / "a.h5"))
    with h5py.File(tmp_path / "a.h5", "w") as file:
        for name, values in COLUMNS.items():
            role, _, unit = name.partition("_")
            file[role] = values
            file[role].attrs["units"] = unit
    check(read_trace(tmp_path / "a.h5"))
    with h5py.File(tmp_path / "b.hdf5", "w") as file:
        for run in ("1", "2"):
            file[f"run/{run}"] = np.array(list(map(tuple, ROWS)), [(name, float) for name in COLUMNS])
    with pytest.raises(TraceError, match=r"2 tables can be the trace: 'run\.1', 'run\.2'"):
        read_trace(tmp_path / "b.hdf5")
    check(read_trace(tmp_path / "b.hdf5", sheet="run.2"))


def write_mat(path, write):
    """As MATLAB's save(..., '-v7.3'): a header of 512 bytes, then HDF5 whose vectors are rows."""
    with h5py.File(path, "w", userblock_size=512) as file:
        write(file)
    with path.open("r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(116) + bytes(8) + b"\x00\x02IM")


def put(group, name, values, kind="double"):
    group[name] = values
    group[name].attrs["MATLAB_class"] = np.bytes_(kind)


def vectors(group):
    for name, values in COLUMNS.items():
        put(group, name, values[np.newaxis])


def test_a_mat_file_of_version_7_3(tmp_path):
    def plain(file):
        vectors(file)
        put(file, "about", np.frombuffer("a text".encode("utf-16-le"), np.uint16)[np.newaxis], "char")

    def structures(file):
        references = {name: [] for name in COLUMNS}
        for i in range(2):
            vectors(file.create_group(f"#refs#/{i}"))
            for name in COLUMNS:
                references[name].append(file[f"#refs#/{i}/{name}"].ref)
        for name, held in references.items():
            put(file, f"run/{name}", np.array(held, h5py.ref_dtype)[np.newaxis], "struct")

    def matrix(file):
        put(file, "all", np.array(ROWS).T)

    write_mat(tmp_path / "a.mat", plain)
    check(read_trace(tmp_path / "a.mat"))
    write_mat(tmp_path / "b.mat", structures)
    with pytest.raises(TraceError, match=r"2 tables can be the trace: 'run\.1', 'run\.2'"):
        read_trace(tmp_path / "b.mat")
    check(read_trace(tmp_path / "b.mat", sheet="run.1"))
    write_mat(tmp_path / "c.mat", matrix)
    named, units = {"time": 1, "depth": 2, "force": 3}, {"time": "s", "depth": "mm", "force": "N"}
    check(read_trace(tmp_path / "c.mat", named, units))


@pytest.mark.parametrize("name", ["a.xls", "a.h5"])
def test_a_damaged_one_is_named(tmp_path, name):
    if name == "a.xls":
        write_xls(tmp_path / name, ["A"])
    else:
        with h5py.File(tmp_path / name, "w") as file:
            vectors(file)
    good = (tmp_path / name).read_bytes()
    (tmp_path / name).write_bytes(good[: len(good) // 3])
    with pytest.raises(TraceError, match=rf"{name}: is damaged or cut off: it begins as (XLS|HDF5), and"):
        read_trace(tmp_path / name)


def test_a_dataset_that_expands_too_far_is_refused_before_it_is_read(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        for name in COLUMNS:
            file.create_dataset(name, (50_000_000,), "f8", compression="gzip")
    assert (tmp_path / "a.h5").stat().st_size < 100_000
    with pytest.raises(TraceError, match="holds 150,000,000 numbers or more; the limit is 100,000,000"):
        read_trace(tmp_path / "a.h5")


@pytest.mark.parametrize(("name", "package"), [("a.xls", "xlrd"), ("a.h5", "h5py")])
def test_a_missing_package_is_named_with_its_extra(tmp_path, name, package, monkeypatch):
    (tmp_path / name).write_bytes({"xlrd": b"\xd0\xcf\x11\xe0", "h5py": b"\x89HDF"}[package] + bytes(600))
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(MissingPackageError, match=f"needs the package {package}, of the extra 'formats'"):
        read_trace(tmp_path / name)

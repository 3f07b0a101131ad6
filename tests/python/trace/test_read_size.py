"""Files of some kilobytes that expand to more than a trace may hold are refused before memory is taken for them."""

import os
import subprocess
import sys
import warnings
import zipfile

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import scipy.io
from openpyxl import Workbook
from punctura.trace import TraceError, read_trace
from punctura.trace.look import look_at

LONG = "depth_" + "x" * 300


def columns(count=3, rows=10):
    return {f"column{i}": np.zeros(rows, np.int8) for i in range(count)}


def parquet(path, table):
    pq.write_table(pa.table(table), path, compression="zstd")


def mat(path, table):
    scipy.io.savemat(path, table, do_compression=True, long_field_names=True)


def xlsx(path, table):
    book = Workbook(write_only=True)
    sheet = book.create_sheet()
    sheet.append(list(table))
    for row in zip(*table.values(), strict=True):
        sheet.append([int(cell) for cell in row])
    book.save(path)


def csv(path, table):
    rows = [",".join(table)] + [",".join(map(str, row)) for row in zip(*table.values(), strict=True)]
    path.write_text("\n".join(rows))


WRITERS = {"a.parquet": parquet, "a.mat": mat, "a.xlsx": xlsx, "a.csv": csv}


def in_little_memory(*paths):
    """What reading says of each file in a process that may take 500 MB more than it has after its imports."""
    code = (
        "import resource, sys, scipy.io\n"
        "from punctura.trace import TraceError, read_trace\n"
        "used = 4096 * int(open('/proc/self/statm').read().split()[0])\n"
        "resource.setrlimit(resource.RLIMIT_AS, (used + 500_000_000,) * 2)\n"
        "for path in sys.argv[1:]:\n"
        "  try: read_trace(path)\n"
        "  except TraceError as error: print(error)\n"
    )
    arguments = [sys.executable, "-c", code, *map(str, paths)]
    return subprocess.run(arguments, capture_output=True, text=True, check=True).stdout.splitlines()


@pytest.mark.parametrize("name", WRITERS)
def test_a_thousand_columns_are_the_limit(tmp_path, name):
    WRITERS[name](tmp_path / name, columns(1001))
    with pytest.raises(TraceError, match=f"{name}: has 1,001 columns; the limit is 1,000. Export only depth, force"):
        read_trace(tmp_path / name)


@pytest.mark.parametrize("name", ["a.parquet", "a.xlsx", "a.csv"])  # a name in a MAT file has at most 63 characters
def test_the_name_of_a_column_has_a_limit(tmp_path, name):
    WRITERS[name](tmp_path / name, columns() | {LONG: np.zeros(10, np.int8)})
    with pytest.raises(TraceError, match=r"column 4, 'depth_x+'..., has 306 characters; the limit is 200. Give it a"):
        read_trace(tmp_path / name)


@pytest.mark.statistics
def test_small_files_with_too_many_numbers_are_refused_before_these_are_read(tmp_path):
    paths = [tmp_path / name for name in ("a.parquet", "a.mat", "structure.mat")]
    parquet(paths[0], columns(2, 55_000_000))
    mat(paths[1], columns(2, 55_000_000))
    mat(paths[2], {"trial": columns(2, 55_000_000)})
    assert all(path.stat().st_size < 500_000 for path in paths)
    printed = in_little_memory(*paths)
    assert all(
        "holds 110,000,000 numbers or more; the limit is 100,000,000. Export only" in line for line in printed[:2]
    )
    assert "structures of more than 100 MB; that is the limit. Save depth" in printed[2]


@pytest.mark.statistics
def test_a_long_text_file_takes_a_few_times_its_size(tmp_path):
    rows = "".join(f"{0.001 * i:.4f},{1e-5 * i:.6f},{0.1 * (i % 100):.5f}\n" for i in range(40_000))
    (tmp_path / "a.csv").write_text("time_s,depth_mm,force_N\n" + 40 * rows)
    assert (tmp_path / "a.csv").stat().st_size > 35_000_000
    printed = in_little_memory(tmp_path / "a.csv")  # 1.6 million rows; as a list of lines and cells they take 600 MB
    assert printed == []


def test_a_text_file_with_too_many_numbers_is_refused_before_they_are_read(tmp_path, monkeypatch):
    monkeypatch.setattr("punctura.trace.table.MOST_NUMBERS", 5_000)
    monkeypatch.setattr("punctura.trace.text._parsed", lambda *_: pytest.fail("read"))
    (tmp_path / "a.csv").write_text("time_s;depth_mm;force_N\n" + 2_000 * "0;1;2\n")
    with pytest.raises(TraceError, match=r"a.csv: holds 6,003 numbers or more; the limit is 5,000. Export only depth"):
        read_trace(tmp_path / "a.csv")


ROWS = "".join(f"{0.001 * i:.4f},{1e-5 * i:.6f},{0.1 * (i % 100):.5f}\n" for i in range(1000))
ODD = {  # and what is said of it
    "blank": (50_000_000 * b"\n", "is empty"),
    "spaces": (1_000_000 * b"   \t\r\n", "is empty"),
    "sparse": (9 * (999_999 * b"\n" + b"0.1,2,3\n"), "no column is known to be the depth"),
    "comments": (2_000_000 * b"#\n", "is empty"),
    "ragged": (ROWS.encode() + 2_000_000 * b"1\n" + ROWS.encode(), "is no table of numbers"),
    "hole": (b"time_s,depth_mm,force_N\n" + ROWS.encode() + 10_000_000 * b"\0", "a line has more than 200,000 char"),
    "spaced": (20 * ROWS.replace(",", 8 * " ").encode(), "no column is known to be the depth"),
}


@pytest.mark.statistics
def test_what_is_hardly_a_table_takes_little_memory(tmp_path):
    paths = [tmp_path / f"{name}.csv" for name in ODD]
    for path, (data, _) in zip(paths, ODD.values(), strict=True):
        path.write_bytes(data)
    for answer, path, (_, words) in zip(in_little_memory(*paths), paths, ODD.values(), strict=True):
        assert answer.startswith(f"{path}: {words}")


def test_a_text_has_a_smaller_limit_than_a_packed_file(tmp_path):
    with (tmp_path / "a.csv").open("wb") as file:
        file.write(b"time_s,depth_mm,force_N\n" + ROWS.encode())
        file.truncate(1_900_000_000)
    with pytest.raises(TraceError, match=r"a.csv: has 1.9 GB of text; the limit is 0.5 GB. Export only depth"):
        read_trace(tmp_path / "a.csv")


def test_the_first_bytes_of_a_text_are_no_length(tmp_path):
    beginnings = [b"time", b"PAR", b"\xff\xff\xff\xff\xff\xff\xff\x7f"]
    paths = [tmp_path / f"{i}.csv" for i in range(len(beginnings))]
    for path, beginning in zip(paths, beginnings, strict=True):
        with path.open("wb") as file:
            file.write(beginning + b"_s,depth_mm,force_N\n")
            file.truncate(3_000_000_000)
    answers = in_little_memory(*paths)
    assert ["has 3.0 GB; the limit is 2 GB" in answer for answer in answers] == [True] * len(paths)


def test_lines_that_cross_the_pieces_are_read_whole(tmp_path, monkeypatch):
    plain, small = tmp_path / "a.csv", tmp_path / "b.csv"
    for path, end in ((plain, "\n"), (small, "\r\n")):
        path.write_bytes(("% made by hand\n\ntime_s,depth_mm,force_N\n" + ROWS).replace("\n", end).encode())
    expected = read_trace(plain)
    monkeypatch.setattr("punctura.trace.lines._PIECE", 7)
    read = read_trace(small)
    assert np.array_equal(read.force, expected.force) and np.array_equal(read.time, expected.time)


@pytest.mark.parametrize("part, size", [("xl/styles.xml", 9_000_000), ("xl/sharedStrings.xml", 65_000_000)])
def test_a_part_of_a_workbook_that_expands_is_refused(tmp_path, part, size):
    xlsx(tmp_path / "a.xlsx", columns())
    with warnings.catch_warnings(), zipfile.ZipFile(tmp_path / "a.xlsx", "a", zipfile.ZIP_DEFLATED) as archive:
        warnings.simplefilter("ignore")  # the part is there already
        archive.writestr(part, b" " * size)
    with pytest.raises(TraceError, match=f"its part '{part}' expands to {size // 1_000_000} MB; the limit is"):
        read_trace(tmp_path / "a.xlsx")


def test_one_wide_row_does_not_make_all_rows_wide(tmp_path, monkeypatch):
    monkeypatch.setattr("punctura.trace.table.MOST_NUMBERS", 100_000)
    book = Workbook(write_only=True)
    sheet = book.create_sheet()
    for _ in range(110):
        sheet.append([1])
    sheet.append([None] * 998 + [1])
    book.save(tmp_path / "a.xlsx")
    with pytest.raises(TraceError, match="holds 110,889 numbers or more"):
        read_trace(tmp_path / "a.xlsx")


def test_a_message_lists_a_few_of_many_columns(tmp_path):
    csv(tmp_path / "a.csv", columns(900))
    with pytest.raises(TraceError, match="'column29' and 870 more"):
        read_trace(tmp_path / "a.csv")


@pytest.mark.parametrize("read", [read_trace, look_at])
def test_a_pipe_and_a_device_are_refused_before_they_are_opened(tmp_path, read):
    if not hasattr(os, "mkfifo"):
        pytest.skip("makes a pipe")
    os.mkfifo(tmp_path / "a.csv")
    for path in (tmp_path / "a.csv", "/dev/zero"):
        with pytest.raises(TraceError, match=f"{path}: is a pipe or a device; save the trace in a file"):
            read(path)


@pytest.mark.parametrize("name", ["a.csv", "a.mat", "a.xlsx"])
def test_a_file_with_a_hole_of_a_terabyte_is_refused(tmp_path, name):
    with (tmp_path / name).open("wb") as file:
        file.truncate(10**12)
    with pytest.raises(TraceError, match=f"{name}: has 1,000.0 GB; the limit is 2 GB. Export only"):
        read_trace(tmp_path / name)

"""A file that its reader cannot read: what is wrong, where, and what to do."""

import errno
import os

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import scipy.io
from openpyxl import Workbook
from punctura.trace import TraceError, read_trace
from punctura.trace.table import unreadable

TIME = np.arange(200) * 0.01
COLUMNS = {"time_s": TIME, "depth_mm": 5 * TIME, "force_N": 0.1 * TIME}
DAMAGED = (
    r"is damaged or cut off: it begins as {}, and the rest cannot be read \(.+\)\. Copy it again, or export it again"
)


def xlsx(path):
    book = Workbook()
    for row in [list(COLUMNS), *np.column_stack(list(COLUMNS.values())).tolist()]:
        book.active.append(row)
    book.save(path)


KINDS = {
    "a.parquet": ("Parquet", lambda path: pq.write_table(pa.table(COLUMNS), path)),
    "a.mat": ("MAT", lambda path: scipy.io.savemat(path, COLUMNS, do_compression=True)),
    "a.xlsx": ("XLSX", xlsx),
}


@pytest.mark.parametrize("name", KINDS)
def test_a_damaged_file_is_named_with_what_to_do(tmp_path, name):
    kind, write = KINDS[name]
    path = tmp_path / name
    write(path)
    good = path.read_bytes()
    assert len(read_trace(path)) == 200
    noise = np.random.default_rng(1).bytes(len(good) // 3)
    for damaged in (good[: len(good) // 2], good[: len(good) // 3] + noise + good[len(good) // 3 + len(noise) :]):
        path.write_bytes(damaged)
        with pytest.raises(TraceError, match=f"{name}: {DAMAGED.format(kind)}"):
            read_trace(path)
    path.write_bytes(b"")
    with pytest.raises(TraceError, match=f"{name}: is empty; export or copy it again"):
        read_trace(path)
    path.write_text("time_s,depth_mm,force_N\n0,1,2\n")
    with pytest.raises(TraceError, match=f"{name}: is no {kind} file, although its name ends in {path.suffix}"):
        read_trace(path)


def test_pages_of_a_parquet_file_that_do_not_expand_are_damage_and_no_error_of_the_disk(tmp_path):
    path = tmp_path / "a.parquet"
    pq.write_table(pa.table(COLUMNS), path, compression="snappy", use_dictionary=False)
    damaged = bytearray(path.read_bytes())
    damaged[60:900] = np.random.default_rng(2).bytes(840)
    path.write_bytes(damaged)
    with pytest.raises(TraceError, match=DAMAGED.format("Parquet")):
        read_trace(path)


def test_an_error_of_the_system_is_told_as_such(tmp_path):
    path = tmp_path / "a.mat"
    path.write_bytes(b"MATLAB")
    with pytest.raises(OSError, match=os.strerror(errno.EIO)):
        unreadable(path, "MAT", OSError(errno.EIO, os.strerror(errno.EIO), str(path)))


def test_a_place_before_the_beginning_of_a_file_is_damage(tmp_path):
    path = tmp_path / "a.xlsx"
    path.write_bytes(b"PK")
    assert "is damaged or cut off" in str(unreadable(path, "XLSX", OSError(errno.EINVAL, os.strerror(errno.EINVAL))))


def test_another_table_within_the_numbers_is_no_part_of_the_first(tmp_path):
    rows = "".join(f"{0.1 * i:.1f},{i},{i * i}\n" for i in range(20))
    path = tmp_path / "trace.csv"
    path.write_text(f"time_s,depth_mm,force_N\n{rows}\ntime_s,depth_mm,force_mN\n{rows}")
    with pytest.raises(TraceError, match=r"behind 20 rows .* \(time_s, depth_mm, force_mN\).* a file of its own"):
        read_trace(path)
    path.write_text(f"time_s,depth_mm,force_N\n{rows}\nmax. time_s,max. depth_mm,max. force_N\n1.9,19,361\n")
    assert len(read_trace(path)) > 19  # a table of results at the end is as short as that


def test_another_table_within_a_sheet_is_no_part_of_the_first(tmp_path):
    rows = [[0.1 * i, i, i * i] for i in range(20)]
    book = Workbook()
    for row in (
        ["time_s", "depth_mm", "force_N"],
        *rows,
        [],
        ["Specimen 2"],
        ["time_s", "depth_mm", "force_mN"],
        *rows,
    ):
        book.active.append(row)
    book.save(tmp_path / "a.xlsx")
    with pytest.raises(TraceError, match=r"behind 20 rows .* \(time_s, depth_mm, force_mN\).* a file of its own"):
        read_trace(tmp_path / "a.xlsx")
    sheet = book.create_sheet("Trace")
    for row in (["time_s", "depth_mm", "force_N"], *rows):
        sheet.append(row)
    book.save(tmp_path / "a.xlsx")
    assert len(read_trace(tmp_path / "a.xlsx", sheet="Trace")) == 20

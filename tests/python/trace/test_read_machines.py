"""Files as testing machines and other programs write them: reports above the table, rows of units, other encodings."""

import numpy as np
import pytest
import scipy.io
from openpyxl import Workbook
from punctura.trace import TraceError, read_trace
from traces import trace

MADE = trace()


def lines(pattern, comma=False):
    """One line for each sample, with time in s, depth in mm and force in N."""
    rows = zip(MADE.time, MADE.depth * 1e3, MADE.force, strict=True)
    texts = [[repr(float(cell)) for cell in row] for row in rows]
    return [pattern.format(*(text.replace(".", ",") if comma else text for text in row)) for row in texts]


def text_of(head, pattern, comma=False):
    return "\n".join([*head, *lines(pattern, comma)]) + "\n"


FILES = {
    "units below the names": text_of(['"Time","Extension","Load"', '"(sec)","(mm)","(N)"'], '"{}","{}","{}"').encode(),
    "a specimen and a gauge in the names": text_of(
        ["Specimen 1 Time,Specimen 1 Displacement (Strain 1),Specimen 1 Force", "s,mm,N"], "{},{},{}"
    ).encode(),
    "report above the table": text_of(
        ["Results Table 1", "Label,liver 3", "Speed,300,mm/min", "", "Time (sec),Extension (mm),Load (N)"], "{},{},{}"
    ).encode(),
    "a table of results of the same width above": text_of(
        [
            "Results Table 1",
            ",Maximum Load (N),At (mm)",
            "1,0.61,8.1",
            "Mean,0.61,8.1",
            "",
            "Time,Extension,Load",
            "s,mm,N",
        ],
        "{},{},{}",
    ).encode(),
    "channels and ranges between names and units": text_of(
        ["Channel,Time,Extension,Load", "No,CH1,CH2,CH3", "Range,10,10,10", ",,,", "Unit,s,mm,N"], "7,{},{},{}"
    ).encode(),
    "bars between the columns": text_of(["Time (s)|Depth (mm)|Force (N)"], "{}|{}|{}").encode(),
    "German, of a Windows program": text_of(
        ["Prüfbericht;12", "Datum;23.11.2026", "", "Prüfzeit;Standardweg;Standardkraft", "s;mm;N"], "{};{};{}", True
    ).encode("cp1252"),
    "decimal commas in quotes": text_of(['"Zeit [s]","Weg [mm]","Kraft [N]"'], '"{}","{}","{}"', True).encode(),
    "decimal commas between spaces": text_of(["time_s depth_mm force_N"], " {}   {}  {}", True).encode(),
    "UTF-16": text_of(["Time (s)\tPosition (mm)\tForce (N)"], "{}\t{}\t{}").encode("utf-16"),
    "names in a comment": text_of(["# made by a robot", "# time_s,depth_mm,force_N"], "{},{},{}").encode(),
    "a last line that was cut": (text_of(["Elapsed Time (s),depth_mm,force_N"], "{},{},{}") + "9.9").encode(),
    "a row of channels below the units": text_of(
        ["Name,Time,Depth,Force", "Unit,s,mm,N", "Channel,0,1,2"], "7,{},{},{}"
    ).encode(),
    "a line below the units": text_of(["Zeit;Weg;Kraft", "s;mm;N", "-;-;-"], "{};{};{}").encode(),
    "names over two lines": text_of(['"Time\n(s)","Depth\n(mm)","Force\n(N)"'], "{},{},{}").encode(),
    "units above the names": text_of(["[s],[mm],[N]", "Time,Depth,Force"], "{},{},{}").encode(),
    "units in brackets between spaces": text_of(["Time (s) Depth (mm)  Force (N)"], "{} {} {}").encode(),
    "a remark below the first row": text_of(["t_s,depth_mm,force_N"], "{},{},{}").replace("\n", "\n# x\n", 2).encode(),
    "a line of text at the end": (text_of(["t_s;depth_mm;force_N"], "{};{};{}") + "End of test\n").encode(),
}


@pytest.mark.parametrize("what", FILES)
def test_what_machines_write_is_read(tmp_path, what):
    path = tmp_path / "a.csv"
    path.write_bytes(FILES[what])
    read = read_trace(path)
    assert read.depth == pytest.approx(MADE.depth, rel=1e-12) and read.force == pytest.approx(MADE.force, rel=1e-12)
    assert read.time == pytest.approx(MADE.time, rel=1e-12)
    broken = [f"{len(MADE) + 1}"] if "last line" in what or "at the end" in what else []
    assert [f.text.split("row ")[1].split(";")[0] for f in read.findings] == broken


def test_a_row_with_other_cells_is_named_by_its_place(tmp_path):
    rows = lines("{},{},{}")
    rows[6] = "stopped"
    (tmp_path / "a.csv").write_text("\n".join(["time_s,depth_mm,force_N", *rows]))
    read = read_trace(tmp_path / "a.csv")
    assert read.depth == pytest.approx(np.delete(MADE.depth, 6))
    [finding] = read.findings
    assert finding.kind == "rows_without_numbers" and "1 of" in finding.text and "row 7" in finding.text


def test_a_report_in_a_workbook_is_skipped(tmp_path):
    book = Workbook()
    for row in (["Test report", None, 3], [], ["Time", "Displacement", "Force"], ["s", "mm", "N"]):
        book.active.append(row)
    for row in zip(MADE.time, MADE.depth * 1e3, MADE.force, strict=True):
        book.active.append([float(cell) for cell in row])
    book.save(tmp_path / "a.xlsx")
    assert read_trace(tmp_path / "a.xlsx").force == pytest.approx(MADE.force)


def test_a_matrix_in_a_mat_file_has_numbered_columns(tmp_path):
    scipy.io.savemat(tmp_path / "a.mat", {"data": np.column_stack((MADE.time, MADE.depth, MADE.force))})
    columns, units = {"time": 1, "depth": 2, "force": 3}, {"time": "s", "depth": "m", "force": "N"}
    assert read_trace(tmp_path / "a.mat", columns, units).force == pytest.approx(MADE.force)


def test_two_tables_side_by_side_are_asked_for(tmp_path):
    (tmp_path / "a.csv").write_text(
        text_of(["time_s,depth_mm,force_N,force_N"], "{0},{1},{2},{0}")
    )  # the second force is of another specimen
    with pytest.raises(TraceError, match="more than one column could be the force"):
        read_trace(tmp_path / "a.csv")


def test_the_second_table_is_chosen_by_the_numbers_of_its_columns(tmp_path):
    (tmp_path / "a.csv").write_text(text_of([f"{'Time (s),Depth (mm),Force (N),' * 2}x"], "7,{1},{2},{0},{1},{2},7"))
    assert read_trace(tmp_path / "a.csv", {"time": 4, "depth": 5, "force": 6}).depth == pytest.approx(MADE.depth)


def test_many_lines_of_remarks_may_stand_below_the_table(tmp_path):
    (tmp_path / "a.csv").write_text(text_of(["time_s,depth_mm,force_N"], "{},{},{}") + "\n" + 300 * "# end of test\n")
    assert read_trace(tmp_path / "a.csv").force == pytest.approx(MADE.force)


def test_a_file_that_is_no_text_is_named(tmp_path):
    (tmp_path / "a.csv").write_bytes(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR")
    with pytest.raises(TraceError, match="is no text, Parquet, MAT, XLSX or HDF5 file; export the table as CSV"):
        read_trace(tmp_path / "a.csv")
    (tmp_path / "b.csv").write_text("only,words\nare,here\n")
    with pytest.raises(TraceError, match="holds no rows of numbers"):
        read_trace(tmp_path / "b.csv")


MIXED = ["time_s;depth_mm;force_N", *(f"{k},5;{k},25;{k}.234" for k in range(1, 9))]


def test_a_number_of_two_readings_is_asked_for(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("\n".join(MIXED))
    with pytest.raises(TraceError, match=r"is the point in 1\.234 a decimal point.*--decimal comma"):
        read_trace(path)
    assert read_trace(path, decimal=",").force == pytest.approx(1000 * np.arange(1, 9) + 234)
    path.write_text("\n".join(MIXED).replace(",5", ".5").replace(",25", ".25").replace("1.5;", '"1,5";'))
    assert read_trace(path, decimal=".").force[:2] == pytest.approx([2.234, 3.234])  # without row 1


def test_a_column_among_decimal_commas_may_have_decimal_points(tmp_path):
    (tmp_path / "a.csv").write_text(
        "\n".join(["time_s;depth_mm;force_N", *(f"{k},5;{k},25;0.{k}" for k in range(1, 9))])
    )
    assert read_trace(tmp_path / "a.csv").force == pytest.approx(np.arange(1, 9) / 10)


@pytest.mark.parametrize(("thousands", "force"), [("1.234,5", 1234.5), ("1.234.567,5", 1234567.5), ("1,5e3", 1500.0)])
def test_marks_between_thousands_are_clear_beside_a_decimal_comma(tmp_path, thousands, force):
    path = tmp_path / "a.csv"
    path.write_text("\n".join([MIXED[0], *(f"{k},5;{k},25;{thousands}" for k in range(1, 9))]))
    assert read_trace(path).force == pytest.approx(np.full(8, force))

"""An invalid motion is rejected with file, line, problem and remedy, and leaves no output file."""

import numpy as np
import pytest
from punctura import ConfigurationError, simulate
from punctura.simulation import MotionError

from .simulate_motions import AXIS_HEADER, HEADER, rows_of, strokes

TIME, POSITION = strokes(100)
LINES = rows_of(TIME, POSITION, stamp="%.9g")
WANTED = "the columns must be time_s,x_m,y_m,z_m or time_s,x_m,y_m,z_m,axis_x,axis_y,axis_z"


def error_of(tmp_path, lines, raw=None):
    path = tmp_path / "motion.csv"
    path.write_bytes(raw if raw is not None else "".join(line + "\n" for line in lines).encode())
    with pytest.raises(MotionError) as caught:
        simulate("k06-fig10", path, tmp_path / "out.csv")
    assert [p.name for p in tmp_path.iterdir()] == ["motion.csv"]
    message = str(caught.value)
    assert message.startswith(f"{path}")
    return message.removeprefix(f"{path}").removeprefix(", ")


def spoilt(line, old_to_new):
    """The motion with one of its lines (numbered as in the file) changed."""
    lines = [HEADER, *LINES]
    lines[line - 1] = old_to_new(lines[line - 1])
    return lines


def with_field(line, column, text):
    def change(row):
        fields = row.split(",")
        fields[column] = text
        return ",".join(fields)

    return spoilt(line, change)


HEADERS = {
    "": f"line 1: is empty; {WANTED}",
    "time_s;x_m;y_m;z_m": "line 1: the columns are separated by semicolons; use commas, and decimal points in numbers",
    "time_s\tx_m\ty_m\tz_m": "line 1: the columns are separated by tabs; use commas, and decimal points in numbers",
    "time_s,x_m,y_m": f"line 1: column z_m is missing; {WANTED}",
    "time_s,x_m,y_m,z_m,axis_x": f"line 1: columns axis_y, axis_z are missing; {WANTED}",
    "time_s,x_m,y_m,z_m,note": f"line 1: column 'note' is unknown; {WANTED}",
    "time_s,x_mm,y_m,z_m": f"line 1: column x_m is missing, column 'x_mm' is unknown (did you mean x_m?); {WANTED}",
    "time_s,x_m,z_m,y_m": f"line 1: the columns are in another order, time_s,x_m,z_m,y_m; {WANTED}",
    "time_s,x_m,y_m,z_m,z_m": f"line 1: column z_m appears twice; {WANTED}",
    "time_s,x_m,y_m,y_m,z_m,z_m": f"line 1: columns y_m, z_m appear twice; {WANTED}",
    "0,0,0.001,0": f"line 1: the first line holds numbers, not the names of the columns; {WANTED}",
}


@pytest.mark.parametrize("header", HEADERS)
def test_wrong_columns_are_reported(tmp_path, header):
    assert error_of(tmp_path, [header, *LINES]) == HEADERS[header]


FIELDS = {
    "nan": "y_m is nan; fill the sample in, or cut the motion there",
    "-Inf": "y_m is -Inf; fill the sample in, or cut the motion there",
    "": "y_m is empty; fill the sample in, or cut the motion there",
    "down": "y_m is 'down', which is not a number",
    "1_0": "y_m is '1_0', which is not a number",
    "0x1p3": "y_m is '0x1p3', which is not a number",
    "NULL": "y_m is 'NULL', which is not a number",
    "1e999": "y_m is 1e999, which is too large for a number",
    '"0,001"': "y_m is '0,001', with a decimal comma; write 0.001",
}


@pytest.mark.parametrize("text", FIELDS)
@pytest.mark.parametrize("block_bytes", [300, 1 << 20])
def test_a_value_that_is_no_finite_number_is_told_with_its_line(tmp_path, monkeypatch, text, block_bytes):
    monkeypatch.setattr("punctura.simulation.motion_file.BLOCK_BYTES", block_bytes)
    assert error_of(tmp_path, with_field(57, 2, text)) == f"line 57: {FIELDS[text]}"


def test_lines_of_another_length_are_reported(tmp_path):
    each = "write one each for time_s,x_m,y_m,z_m"
    assert error_of(tmp_path, spoilt(9, lambda row: "0.1,0.2,0.3")) == f"line 9: holds 3 values for 4 columns; {each}"
    assert error_of(tmp_path, spoilt(9, lambda row: "0.1")) == f"line 9: holds 1 value for 4 columns; {each}"
    assert error_of(tmp_path, spoilt(9, lambda row: row + ",7")) == f"line 9: holds 5 values for 4 columns; {each}"
    assert error_of(tmp_path, spoilt(9, lambda row: "0,1,0,2,0,3,0,4")) == (
        "line 9: holds 8 values for 4 columns; replace decimal commas by points"
    )
    assert error_of(tmp_path, spoilt(9, lambda row: "0,1;0,2;0,3;0,4")) == (
        "line 9: holds 5 values for 4 columns; use commas, and decimal points in numbers"
    )


def test_a_blank_line_in_the_middle_is_reported(tmp_path):
    assert error_of(tmp_path, spoilt(30, lambda row: "")) == "line 30: is empty; remove the line, or fill it in"


def test_an_empty_file_and_one_without_motion_are_reported(tmp_path):
    empty = ": is empty; it must hold a line of column names and the motion below it"
    assert error_of(tmp_path, [], raw=b"") == empty
    assert error_of(tmp_path, [HEADER]) == "line 2: there is no motion below the column names"
    assert error_of(tmp_path, [HEADER, "", ""]) == "line 2: there is no motion below the column names"


def test_a_file_that_is_no_text_is_reported(tmp_path):
    save = "is not UTF-8 text; save the file as CSV, UTF-8"
    assert error_of(tmp_path, [], raw="\ufefftime_s".encode("utf-16-le")) == f"line 1: {save}"
    assert error_of(tmp_path, [], raw=HEADER.encode() + b"\n0,0,\xff,0\n") == f"line 2: {save}"


def test_a_line_that_is_no_csv_is_reported(tmp_path):
    assert error_of(tmp_path, spoilt(9, lambda row: "7" * 200_000)) == (
        "line 9: is not CSV (field larger than field limit (131072))"
    )


@pytest.mark.parametrize(
    ("axis", "report"),
    [
        ("0,0,0", "axis_x, axis_y, axis_z are all 0; they must give a direction"),
        ("0,inf,0", "axis_y is inf; fill the sample in, or cut the motion there"),
    ],
)
def test_a_direction_of_no_length_or_that_is_not_finite_is_reported(tmp_path, axis, report):
    lines = [f"{line},0,-1,0" for line in LINES]
    lines[40] = f"{LINES[40]},{axis}"
    assert error_of(tmp_path, [AXIS_HEADER, *lines]) == f"line 42: {report}"


@pytest.mark.parametrize("block_bytes", [300, 1 << 20])
def test_a_gap_is_told_with_the_line_after_it(tmp_path, monkeypatch, block_bytes):
    monkeypatch.setattr("punctura.simulation.motion_file.BLOCK_BYTES", block_bytes)
    assert error_of(tmp_path, [HEADER, *LINES[:60], *LINES[61:]]) == (
        "line 62: a gap from 0.036875 s to 0.038125 s (1 sample missing at 0.000625 s a step); "
        "fill it in, or cut the motion there"
    )
    assert "(20 samples missing at" in error_of(tmp_path, [HEADER, *LINES[:60], *LINES[80:]])


@pytest.mark.parametrize("block_bytes", [300, 1 << 20])
@pytest.mark.parametrize(("first", "second"), [(57, 58), (57, 63), (10, 90)])
def test_exchanged_rows_are_time_that_goes_back_not_a_gap(tmp_path, monkeypatch, first, second, block_bytes):
    monkeypatch.setattr("punctura.simulation.motion_file.BLOCK_BYTES", block_bytes)
    rows = list(LINES)
    rows[first - 2], rows[second - 2] = rows[second - 2], rows[first - 2]
    before, now = (rows[line - 2].split(",")[0] for line in (first, first + 1))
    assert error_of(tmp_path, [HEADER, *rows]) == (
        f"line {first + 1}: time_s goes back, from {before} s to {now} s; sort the rows, or cut the motion there"
    )


@pytest.mark.parametrize("block_bytes", [300, 1 << 20])
def test_a_part_of_the_motion_that_comes_too_late_is_time_that_goes_back(tmp_path, monkeypatch, block_bytes):
    monkeypatch.setattr("punctura.simulation.motion_file.BLOCK_BYTES", block_bytes)
    message = error_of(tmp_path, [HEADER, *LINES[:50], *LINES[55:60], *LINES[50:55], *LINES[60:]])
    assert message.startswith("line 57: time_s goes back")


@pytest.mark.parametrize("rows", [98, 99])
def test_a_gap_at_the_end_is_told_with_the_line_after_it(tmp_path, rows):
    assert error_of(tmp_path, [HEADER, *LINES[: rows - 1], *LINES[rows:]]).startswith(f"line {rows + 1}: a gap from")


@pytest.mark.parametrize(("factor", "step"), [(1000, "0.625"), (1.6e6, "1000")])
def test_stamps_in_another_unit_are_refused_not_filled_up_with_made_up_rows(tmp_path, factor, step):
    assert error_of(tmp_path, [HEADER, *rows_of(TIME * factor, POSITION)]) == (
        f": time_s grows by {step} s from row to row, and a motion must have 10 rows a second or more; where time_s is "
        "in another unit, write seconds, else sample the motion more often (numpy.interp does it)"
    )


def test_time_that_goes_back_or_stands_is_reported(tmp_path):
    assert error_of(tmp_path, [HEADER, *LINES[:60], *LINES[50:]]) == (
        "line 62: time_s goes back, from 0.036875 s to 0.03125 s; sort the rows, or cut the motion there"
    )
    assert error_of(tmp_path, [HEADER, *LINES[:60], *LINES[59:]]) == (
        "line 62: time_s stays at 0.036875 s; write the time with more digits, or remove the repeated sample"
    )


def test_stamps_too_coarse_to_tell_the_samples_apart_are_reported(tmp_path):
    assert error_of(tmp_path, [HEADER, *rows_of(TIME, POSITION, stamp="%.2f")]) == (
        "line 3: time_s stays at 0 s; write the time with more digits, or remove the repeated sample"
    )


def test_one_uneven_step_is_reported(tmp_path):
    assert error_of(tmp_path, with_field(50, 0, "0.0303")) == (
        "line 50: time_s is uneven here: 0.0303 s is 0.48 steps off a regular grid of 0.000625 s; "
        "resample the motion evenly first (numpy.interp does it)"
    )
    assert error_of(tmp_path, [HEADER, *LINES[:60], "0.0371,0,0,0", *LINES[60:]]) == (
        "line 62: time_s is uneven here: a step of 0.000225 s instead of the usual 0.000625 s; "
        "resample the motion evenly first (numpy.interp does it)"
    )


def test_irregular_sampling_is_reported(tmp_path):
    time = np.cumsum(np.random.default_rng(1).uniform(1e-4, 3e-3, 100))
    message = error_of(tmp_path, [HEADER, *rows_of(time, POSITION)])
    assert "time_s is uneven here" in message or "a gap from" in message
    assert message.endswith(("(numpy.interp does it)", "cut the motion there"))


@pytest.mark.parametrize("block_bytes", [500, 1 << 20])
def test_a_rate_that_changes_on_the_way_is_told_near_the_change(tmp_path, monkeypatch, block_bytes):
    monkeypatch.setattr("punctura.simulation.motion_file.BLOCK_BYTES", block_bytes)
    time = np.concatenate((np.arange(200), 200 + 1.1 * np.arange(200))) / 1600
    message = error_of(tmp_path, [HEADER, *rows_of(time, np.zeros((400, 3)))])
    assert abs(int(message.split(":")[0].removeprefix("line ")) - 202) < 30
    assert message.endswith("resample the motion evenly first (numpy.interp does it)")


def test_a_line_without_an_end_is_refused(tmp_path):
    message = error_of(tmp_path, [HEADER, *LINES[:3], "0" * 70_000])
    assert message == "line 5: has more than 65,536 bytes; write one row in a line"


def problems_of(*arguments):
    with pytest.raises(ConfigurationError) as caught:
        simulate(*arguments)
    return [str(p) for p in caught.value.problems]


def test_paths_that_cannot_serve_are_told_all_at_once(tmp_path):
    none, out = tmp_path / "none.csv", tmp_path / "folder" / "out.txt"
    assert problems_of("k06-fig10", none, out) == [
        f"motion {none}: there is no such file",
        f"out {out}: must end in .csv or .parquet",
        f"out {out}: there is no folder {out.parent}; make it first",
    ]
    assert problems_of("k06-fig10", tmp_path, tmp_path / "out.csv") == [f"motion {tmp_path}: is not a file"]


def test_the_motion_is_never_written_over(write):
    path = write([HEADER, *LINES])
    before = path.read_bytes()
    assert problems_of("k06-fig10", path, path) == [f"out {path}: is the motion file itself; choose another name"]
    assert path.read_bytes() == before


def test_times_and_places_that_cannot_be_are_told_with_their_line(tmp_path):
    tiny = [f"{k * 5e-324!r},0,0,0" for k in range(500)]
    assert "where time_s is in another unit, write seconds" in error_of(tmp_path, [HEADER, *tiny])
    (tmp_path / "motion.csv").unlink()
    assert error_of(tmp_path, with_field(7, 2, "1e308")).startswith("line 7: x_m, y_m, z_m must be within 1000 km")

"""The numbers of a trace that need no model, against traces whose numbers are known."""

import csv
import json
from dataclasses import replace

import numpy as np
import openpyxl
import pyarrow.parquet
import pytest
from punctura.trace import Trace, TraceError, segment
from punctura.trace.findings import examine
from punctura.trace.numbers import numbers_of
from punctura.trace.numbers_table import spread
from traces import force_of, motion, trace

NEEDLES_WAY = np.concatenate((np.linspace(0, 12e-3, 1201), np.linspace(12e-3, 0, 1201)[1:]))


def triangle(offset=0.0):
    """Air to 2 mm, 200 N/m to 7 mm, a fall of 0.6 N within 0.1 mm, then 0.4 N; on the way out -0.3 N until 2 mm."""
    inward = np.interp(NEEDLES_WAY[:1201], [0, 2e-3, 7e-3, 7.1e-3, 12e-3], [0, 0, 1.0, 0.4, 0.4])
    outward = np.interp(-NEEDLES_WAY[1201:], [-12e-3, -2e-3, -1.9e-3, 0], [-0.3, -0.3, 0, 0])
    time = np.arange(len(NEEDLES_WAY)) * 1e-2
    return Trace(NEEDLES_WAY, np.concatenate((inward, outward)) + offset, time)


@pytest.mark.parametrize("offset", [0.0, 0.05, -0.2])
def test_the_numbers_of_a_trace_drawn_by_hand_whatever_the_zero_of_the_sensor(offset):
    (result,) = numbers_of(triangle(offset))
    assert result.zero_N == pytest.approx(offset, abs=1e-9)
    assert result.contact_m == pytest.approx(2e-3, abs=0.1e-3)
    assert (result.peak_N, result.peak_depth_m) == pytest.approx((1.0, 7e-3))
    assert result.gradient_N_per_m == pytest.approx(200, rel=1e-3)
    assert result.work_J == pytest.approx(0.5 * 5e-3 + 0.07e-3 + 4.9e-3 * 0.4, rel=1e-3)
    assert result.work_out_J == pytest.approx(0.3 * 10e-3, rel=0.01)
    assert result.final_N == pytest.approx(0.4) and result.withdrawal_N == pytest.approx(0.3)
    assert result.speed_m_per_s == pytest.approx(1e-3)
    (pop,) = result.pops
    assert (pop.depth_m, pop.peak_N, pop.drop_N) == pytest.approx((7e-3, 1.0, 0.6))
    assert pop.gradient_N_per_m == pytest.approx(200, rel=1e-3) and pop.width_m == pytest.approx(0.1e-3, rel=0.15)


def test_the_speed_of_a_depth_in_encoder_steps_is_that_of_the_needle():
    made = triangle()
    (result,) = numbers_of(replace(made, depth=np.round(made.depth / 0.055e-3) * 0.055e-3))
    assert result.speed_m_per_s == pytest.approx(1e-3, rel=0.02)


def test_an_angle_changes_the_depth_below_the_surface_alone():
    straight, oblique = (numbers_of(triangle(), angle)[0] for angle in (0.0, np.radians(60)))
    assert straight.peak_below_surface_m == pytest.approx(5e-3, abs=0.1e-3)
    assert oblique.peak_below_surface_m == pytest.approx(straight.peak_below_surface_m / 2)
    assert replace(oblique, peak_below_surface_m=None) == replace(straight, peak_below_surface_m=None)


def test_each_insertion_has_its_own_numbers_and_what_is_not_there_is_none():
    made = trace(noise=0.0, times=2)
    first, second = numbers_of(made)
    clean = force_of(motion(times=2)[1])
    half = len(made) // 2
    assert first.peak_N == pytest.approx(clean[:half].max()) and second.peak_N == pytest.approx(clean[half:].max())
    assert (first.insertion, second.insertion) == (0, 1) and len(first.pops) == 1
    assert first.final_N == pytest.approx(first.withdrawal_N, rel=0.05)  # the friction of the shaft, both ways
    inward = made[: int(np.argmax(made.depth))]
    (only,) = numbers_of(Trace(inward.depth, inward.force))
    assert (only.withdrawal_N, only.work_out_J, only.speed_m_per_s) == (None, None, None)
    assert only.peak_N == first.peak_N and only.work_J == pytest.approx(first.work_J, rel=1e-3)


def test_noise_moves_neither_the_gradient_nor_the_drop():
    clean, noisy = (numbers_of(trace(noise=noise, seed=5))[0] for noise in (0.0, 0.02))
    middle = segment(trace(noise=0.0)).pops[0]
    assert clean.gradient_N_per_m > 0.3 * middle.force / (middle.depth - 5e-3)
    assert noisy.gradient_N_per_m == pytest.approx(clean.gradient_N_per_m, rel=0.05)
    assert noisy.pops[0].drop_N == pytest.approx(clean.pops[0].drop_N, rel=0.15) and noisy.noise_N < 0.025


def test_the_noise_comes_from_air_and_is_not_known_without_it():
    made = trace(noise=5e-3)
    entered, deepest = int(np.argmax(made.depth > 6e-3)), int(np.argmax(made.depth))
    rows = {"in": made[:deepest], "out": made[entered:], "none": made[entered:deepest]}
    noises = {name: numbers_of(one)[0].noise_N for name, one in rows.items()}
    assert noises["in"] == pytest.approx(5e-3, rel=0.2) and noises["out"] == pytest.approx(5e-3, rel=0.2)
    assert noises["none"] is None
    assert "noise" in next(found.text for found in examine(rows["none"]).findings if found.kind == "no_contact")


def test_the_final_force_is_that_of_the_way_in_also_where_a_rest_deeper_in_was_left_out():
    depth = np.concatenate((np.linspace(0, 9e-3, 900), np.linspace(9.8e-3, 0, 980)))
    (result,) = numbers_of(Trace(depth, 100 * np.clip(depth - 2e-3, 0, None), np.arange(len(depth)) * 0.01))
    assert result.final_N == pytest.approx(0.68, abs=0.02)


def test_the_greatest_force_may_be_that_of_the_deepest_sample_where_there_are_few():
    time = np.arange(0, 10, 0.1)
    depth = np.interp(time, [0, 3, 10], [0, 4.5e-3, 4.5e-3])
    force = 200 * depth * np.exp(-np.clip(time - 3, 0, None))  # it relaxes from the first sample of the rest on
    (result,) = numbers_of(Trace(depth, force, time))
    assert result.peak_N == pytest.approx(0.9, abs=1e-6)


def test_a_trace_that_never_goes_in_is_refused():
    made = trace(noise=0.0)
    out = made[int(np.argmax(made.depth)) + 300 :]
    with pytest.raises(TraceError, match="never goes in"):
        numbers_of(Trace(out.depth[:300], out.force[:300]))


def write(path, made, header="time_s,depth_mm,force_N"):
    rows = np.column_stack([made.time, 1e3 * made.depth, made.force])
    np.savetxt(path, rows, delimiter=",", header=header, comments="", fmt="%.8g")


def test_a_folder_gives_one_table_and_its_spread_and_a_broken_file_stops_no_other(punctura, tmp_path):
    folder = tmp_path / "traces"
    folder.mkdir()
    made = [trace(noise=2e-3, seed=seed, surface=surface) for seed, surface in ((1, 4e-3), (2, 5e-3), (3, 6e-3))]
    for i, one in enumerate(made):
        write(folder / f"{i}.csv", one)
    (folder / "broken.csv").write_text("time_s,depth_mm,force_N\n")
    table, parquet = tmp_path / "table.csv", tmp_path / "table.parquet"
    done = punctura("measure", folder, "--json", "--out", table)
    result = json.loads(done.stdout)
    assert done.status == 1 and list(result["failed"]) == ["broken.csv"]
    peaks = [numbers_of(one)[0].peak_N for one in made]
    assert [row["peak_N"] for row in result["rows"]] == pytest.approx(peaks, rel=1e-5)
    spreads = {one["name"]: one for one in result["folder"]}
    assert spreads["peak_N"]["mean"] == pytest.approx(np.mean(peaks)) and spreads["peak_N"]["traces"] == 3
    assert spreads["peak_N"]["sd"] == pytest.approx(np.std(peaks, ddof=1), rel=1e-4) and "pop[0].drop_N" in spreads
    assert spreads["contact_m"]["least"] == pytest.approx(4e-3, abs=0.2e-3)
    with table.open() as file:
        rows = list(csv.DictReader(file))
    assert [float(row["peak_N"]) for row in rows] == pytest.approx(peaks, rel=1e-5) and rows[2]["trace"] == "2.csv"
    assert punctura("measure", folder, "--out", parquet).status == 1
    assert pyarrow.parquet.read_table(parquet).column_names == list(rows[0])


def test_traces_with_different_numbers_of_pops_share_one_table():
    one, two = (
        {"trace": "a", "insertion": 0, "pops": 0},
        {"trace": "b", "insertion": 0, "pops": 1, "pop[0].drop_N": 0.2},
    )
    result = {each["name"]: each for each in spread([one, two])}
    assert (
        result["pop[0].drop_N"]["traces"] == 1
        and result["pop[0].drop_N"]["sd"] is None
        and result["pops"]["mean"] == 0.5
    )


def test_all_sheets_of_a_workbook_a_force_with_a_stated_speed_and_two_files(punctura, tmp_path):
    made = trace(noise=2e-3)
    book = openpyxl.Workbook()
    for name in ("Specimen 1", "Specimen 2"):
        sheet = book.create_sheet(name)
        sheet.append(["time_s", "depth_mm", "force_N"])
        for row in zip(made.time[::5], 1e3 * made.depth[::5], made.force[::5], strict=True):
            sheet.append([float(value) for value in row])
    book.save(tmp_path / "book.xlsx")
    result = json.loads(punctura("measure", tmp_path / "book.xlsx", "--json").stdout)
    assert [row["trace"] for row in result["rows"]] == ["book.xlsx: Specimen 1", "book.xlsx: Specimen 2"]
    np.savetxt(tmp_path / "force.csv", np.column_stack([made.time, made.force]), delimiter=",", header="time_s,force_N",
               comments="")  # fmt: skip
    np.savetxt(tmp_path / "depth.csv", np.column_stack([made.time, 1e3 * made.depth]), delimiter=",",
               header="time_s,depth_mm", comments="")  # fmt: skip
    true = numbers_of(made)[0]
    for words in (["--speed-mm-per-s", "5,0@3,-5@4"], ["--depth-file", tmp_path / "depth.csv"]):
        done = punctura("measure", tmp_path / "force.csv", "--json", *words)
        (row,) = json.loads(done.stdout)["rows"]
        assert (row["peak_N"], row["work_J"]) == pytest.approx((true.peak_N, true.work_J), rel=0.01)
    asked = punctura("measure", tmp_path / "force.csv")
    assert asked.status == 2 and "--speed-mm-per-s" in asked.stderr and "punctura measure" in asked.stderr


def test_the_words_name_each_number_with_its_unit(punctura, tmp_path):
    write(tmp_path / "a.csv", triangle())
    words = punctura("measure", tmp_path / "a.csv", "--angle-deg", 60).stdout
    assert "  peak                 1 N\n" in words and "  gradient             0.2 N/mm\n" in words
    assert "  pop[0].drop          0.6 N\n" in words
    assert punctura("measure", tmp_path / "a.csv", "--out", tmp_path / "a.txt").status == 2


def test_a_soft_layer_in_front_of_the_contact_does_not_move_the_zero():
    made = triangle()
    soft = np.where((NEEDLES_WAY > 0.8e-3) & (np.arange(len(NEEDLES_WAY)) < 1201), 0.05, 0.0)
    (result,) = numbers_of(replace(made, force=made.force + soft))
    assert result.zero_N == pytest.approx(0, abs=1e-9) and result.peak_N == pytest.approx(1.05)


def test_a_first_insertion_that_stays_in_air_has_no_contact():
    whole = triangle()
    force = np.concatenate((1e-3 * whole.force, whole.force))
    twice = Trace(np.tile(whole.depth, 2), force, np.arange(len(force)) * 1e-2)
    first, second = numbers_of(twice)
    assert first.contact_m is None and first.peak_N < 2e-3
    assert second.contact_m == pytest.approx(2e-3, abs=0.1e-3)

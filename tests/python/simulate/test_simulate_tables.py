"""Motions in Parquet and NumPy files."""

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from punctura import simulate
from punctura.simulation import MotionError, motion_file, motion_table

from .simulate_motions import AXIS_HEADER, HEADER, rows_of, strokes

NAMES = AXIS_HEADER.split(",")


def saved(folder, name, rows):
    path = folder / name
    if path.suffix == ".parquet":
        table = dict(zip(NAMES[: rows.shape[1]], rows.T, strict=True)) | {"note": ["x"] * len(rows)}
        pq.write_table(pa.table(table), path)
    elif path.suffix == ".npy":
        np.save(path, rows)
    else:
        parts = {"time": rows[:, 0], "position": rows[:, 1:4]} | ({"axis": rows[:, 4:]} if rows.shape[1] > 4 else {})
        np.savez(path, **parts)
    return path


@pytest.mark.parametrize("name", ["m.parquet", "m.npy", "m.npz"])
@pytest.mark.parametrize("with_axis", [False, True])
def test_a_table_gives_the_forces_of_the_same_csv_file(write, tmp_path, monkeypatch, name, with_axis):
    time, position = strokes(3000)
    axis = np.tile([0.1, -1.0, 0.0], (3000, 1)) if with_axis else None
    rows = np.column_stack([time, position] if axis is None else [time, position, axis])
    motion = write([AXIS_HEADER if with_axis else HEADER, *rows_of(time, position, axis)])
    simulate("k06-fig12", motion, tmp_path / "a.parquet")
    monkeypatch.setattr(motion_table, "ROWS", 1000)
    summary = simulate("k06-fig12", saved(tmp_path, name, rows), tmp_path / "b.parquet")
    assert summary.samples == 3000
    assert pq.read_table(tmp_path / "a.parquet").equals(pq.read_table(tmp_path / "b.parquet"))


@pytest.mark.parametrize("name", ["m.parquet", "m.npy", "m.npz"])
def test_errors_name_the_row_or_the_file(tmp_path, name):
    rows = np.column_stack(strokes(50))
    rows[6, 2] = np.nan
    with pytest.raises(MotionError, match=rf"{name}, row 7: y_m is nan; fill"):
        simulate("k06-fig12", saved(tmp_path, name, rows), tmp_path / "out.csv")
    with pytest.raises(MotionError, match="has no rows"):
        simulate("k06-fig12", saved(tmp_path, name, rows[:0]), tmp_path / "out.csv")
    (tmp_path / name).write_bytes(b"PK no such file")
    with pytest.raises(MotionError, match="cannot be read as a"):
        simulate("k06-fig12", tmp_path / name, tmp_path / "out.csv")
    assert not (tmp_path / "out.csv").exists()


@pytest.mark.parametrize("compression", ["snappy", "none"])
def test_a_damaged_page_names_the_file(tmp_path, compression):
    path = saved(tmp_path, "m.parquet", np.column_stack(strokes(50)))
    pq.write_table(pq.read_table(path), path, compression=compression)
    data = bytearray(path.read_bytes())
    data[4:60] = b"\xff" * 56  # the header of the first page; the footer stays readable
    path.write_bytes(data)
    with pytest.raises(MotionError, match=r"m\.parquet: is damaged: its rows cannot be read"):
        simulate("k06-fig12", path, tmp_path / "out.csv")
    assert not (tmp_path / "out.csv").exists()


def test_wrong_shapes_types_and_columns(tmp_path):
    rows = np.column_stack(strokes(50))
    for name, arrays, message in [
        ("m.npy", rows[:, :3], r"has shape \(50, 3\); it must be"),
        ("m.npy", rows.astype(complex), "holds complex128, not real numbers"),
        ("m.npz", {"time": rows[:, 0]}, "has no array 'position'"),
        ("m.npz", {"time": rows[:, 0], "position": rows[:, 1:3]}, r"position has shape \(50, 2\), not \(50, 3\)"),
    ]:
        path = tmp_path / name
        np.savez(path, **arrays) if isinstance(arrays, dict) else np.save(path, arrays)
        with pytest.raises(MotionError, match=message):
            simulate("k06-fig12", path, tmp_path / "out.csv")
    pq.write_table(pa.table({"time_s": rows[:, 0], "x_m": rows[:, 1], "y_m": rows[:, 2]}), tmp_path / "m.parquet")
    with pytest.raises(MotionError, match="column z_m is missing"):
        simulate("k06-fig12", tmp_path / "m.parquet", tmp_path / "out.csv")


def test_a_short_csv_file_is_parsed_once(write, tmp_path, monkeypatch):
    motion, read = write([HEADER, *rows_of(*strokes(500))]), []
    fast = motion_file._fast_numbers
    monkeypatch.setattr(motion_file, "_fast_numbers", lambda *a: read.append(1) or fast(*a))
    simulate("k06-fig12", motion, tmp_path / "out.csv")
    assert len(read) == 1


def test_a_small_npz_file_that_expands_is_refused_before_it_takes_memory(tmp_path, monkeypatch):
    path = tmp_path / "m.npz"
    np.savez_compressed(path, time=np.zeros(1 << 20), position=np.zeros((1 << 20, 3)))
    assert path.stat().st_size < 100_000
    monkeypatch.setattr(motion_table, "MOST_EXPANDED", 30_000_000)
    monkeypatch.setattr(np, "load", None)
    with pytest.raises(MotionError, match=r"m.npz: expands to 34 MB; the limit is 30 MB. Save it as .npy or .parquet"):
        simulate("k06-fig12", path, tmp_path / "out.csv")

"""The file that comes out holds what the model computes, row by row."""

import csv

import numpy as np
import pyarrow.parquet as pq
import pytest
from punctura import Insertion, Phase, load_scene, simulate

from .simulate_motions import AXIS_HEADER, HEADER, rows_of, strokes

PER_MEMBRANE = ["depth_{}_m", "force_{}_N", "lower_{}_N", "upper_{}_N", "phase_{}"]


def read_csv(path):
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    columns = dict(zip(header, zip(*rows, strict=True), strict=True))
    return {k: list(v) if k.startswith("phase_") else np.array(v, float) for k, v in columns.items()}


def read_parquet(path):
    table = pq.read_table(path)
    return {n: table[n].to_pylist() if n.startswith("phase_") else table[n].to_numpy() for n in table.column_names}


READ = {".csv": read_csv, ".parquet": read_parquet}


def assert_is_the_model(result, scene, position, axis):
    trace = Insertion(scene).run(position, axis)
    for i, name in enumerate(("fx_N", "fy_N", "fz_N")):
        np.testing.assert_array_equal(result[name], trace.force[:, i])
    for i in range(len(scene.membranes)):
        np.testing.assert_array_equal(result[f"depth_{i}_m"], trace.depth[:, i])
        np.testing.assert_array_equal(result[f"force_{i}_N"], trace.axial_force[:, i])
        np.testing.assert_array_equal(result[f"lower_{i}_N"], trace.lower[:, i])
        np.testing.assert_array_equal(result[f"upper_{i}_N"], trace.upper[:, i])
        assert result[f"phase_{i}"] == [Phase(int(v)).name for v in trace.phase[:, i]]


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_the_result_is_the_model_s_to_the_last_bit(write, tmp_path, suffix):
    time, position = strokes(5000)
    out = tmp_path / f"out{suffix}"
    summary = simulate("k06-fig12", write([HEADER, *rows_of(time, position)]), out)
    result = READ[suffix](out)
    assert list(result) == [*HEADER.split(","), "fx_N", "fy_N", "fz_N"] + [
        name.format(i) for i in range(2) for name in PER_MEMBRANE
    ]
    np.testing.assert_array_equal(result["time_s"], time)
    np.testing.assert_array_equal(np.column_stack([result[n] for n in ("x_m", "y_m", "z_m")]), position)
    assert_is_the_model(result, load_scene("k06-fig12"), position, [0, -1, 0])
    assert {"outside", "sticking", "sliding_in", "sliding_out"} <= set(result["phase_0"])
    assert (summary.samples, summary.ticks, summary.resampled, summary.notes) == (5000, 5000, False, [])


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_a_motion_of_many_blocks_runs_on_without_a_seam(write, tmp_path, suffix, monkeypatch):
    monkeypatch.setattr("punctura.simulation.motion_file.BLOCK_BYTES", 1000)
    time, position = strokes(3000)
    out = tmp_path / f"out{suffix}"
    simulate("k06-fig10", write([HEADER, *rows_of(time, position)]), out)
    assert_is_the_model(READ[suffix](out), load_scene("k06-fig10"), position, [0, -1, 0])


def test_a_given_axis_is_a_direction_of_any_length_and_is_written_as_it_came(write, tmp_path):
    time, position = strokes(2000)
    axis = np.column_stack((0.1 + time, np.full(2000, -2.0), np.zeros(2000))) * 1e-3
    out = tmp_path / "out.csv"
    simulate("k06-fig11", write([AXIS_HEADER, *rows_of(time, position, axis)]), out)
    result = read_csv(out)
    assert list(result)[:10] == [*AXIS_HEADER.split(","), "fx_N", "fy_N", "fz_N"]
    np.testing.assert_array_equal(result["axis_y"], axis[:, 1])
    assert_is_the_model(result, load_scene("k06-fig11"), position, axis)


def test_a_scene_may_be_a_scene_a_name_or_a_file(write, tmp_path):
    from punctura import save_scene

    save_scene(load_scene("k06-fig10"), tmp_path / "scene.toml")
    motion = write([HEADER, *rows_of(*strokes(1000))])
    for i, scene in enumerate(["k06-fig10", load_scene("k06-fig10"), tmp_path / "scene.toml"]):
        simulate(scene, motion, tmp_path / f"{i}.csv")
    assert len({(tmp_path / f"{i}.csv").read_bytes() for i in range(3)}) == 1


def test_the_parquet_file_carries_its_scene(write, tmp_path):
    simulate("k06-fig10", write([HEADER, *rows_of(*strokes(10))]), tmp_path / "out.parquet")
    scene = pq.read_schema(tmp_path / "out.parquet").metadata[b"punctura.scene"].decode()
    (tmp_path / "scene.toml").write_text(scene, encoding="utf-8")
    assert load_scene(tmp_path / "scene.toml").name == "K06 Fig. 10"


def test_phases_are_a_dictionary_in_parquet(write, tmp_path):
    simulate("k06-fig10", write([HEADER, *rows_of(*strokes(2000))]), tmp_path / "out.parquet")
    kind = pq.read_schema(tmp_path / "out.parquet").field("phase_0").type
    assert str(kind).startswith("dictionary<values=string")


def test_the_summary_tells_depth_and_strongest_force(write, tmp_path):
    time, position = strokes(1600)
    summary = simulate("k06-fig10", write([HEADER, *rows_of(time, position)]), tmp_path / "out.csv")
    result = read_csv(tmp_path / "out.csv")
    (membrane,) = summary.membranes
    assert membrane.name == "thin membrane"
    assert membrane.deepest_m == result["depth_0_m"].max()
    assert membrane.peak_N == np.abs(result["force_0_N"]).max()
    assert summary.peak_N == pytest.approx(np.hypot(result["fx_N"], result["fy_N"]).max())
    assert (summary.start_s, summary.end_s) == (0.0, time[-1])
    assert summary.motion_rate_hz == pytest.approx(1600)


def test_progress_goes_from_nothing_to_everything(write, tmp_path, monkeypatch):
    monkeypatch.setattr("punctura.simulation.motion_file.BLOCK_BYTES", 1000)
    shares: list[float] = []
    simulate("k06-fig10", write([HEADER, *rows_of(*strokes(1000))]), tmp_path / "out.csv", shares.append)
    assert shares == sorted(shares)
    assert 0 < shares[0] < 0.2 and shares[-1] == 1.0

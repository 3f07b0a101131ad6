"""Which motions count as even, and what becomes of one sampled at another rate."""

import numpy as np
import pytest
from punctura import Insertion, load_scene, simulate
from punctura.simulation.resample import Evenness, Resampler

from .simulate_motions import AXIS_HEADER, HEADER, rows_of, strokes


def table(path, columns):
    return np.genfromtxt(path, delimiter=",", names=True, usecols=columns, dtype=float)


@pytest.mark.parametrize("digits", [4, 5, 6, 9])
def test_stamps_rounded_to_few_digits_are_even(write, tmp_path, digits):
    time, position = strokes(4000)
    exact = simulate("k06-fig10", write([HEADER, *rows_of(time, position)]), tmp_path / "exact.csv")
    rounded = simulate(
        "k06-fig10", write([HEADER, *rows_of(time, position, stamp=f"%.{digits}f")]), tmp_path / "rounded.csv"
    )
    assert not exact.resampled and not rounded.resampled
    force = ["fx_N", "fy_N", "fz_N"]
    np.testing.assert_array_equal(table(tmp_path / "rounded.csv", force), table(tmp_path / "exact.csv", force))


def test_stamps_cut_off_instead_of_rounded_are_even(write, tmp_path):
    time, position = strokes(4000)
    cut = np.floor(time * 1e4) / 1e4
    assert not simulate("k06-fig10", write([HEADER, *rows_of(cut, position)]), tmp_path / "out.csv").resampled


def test_large_time_stamps_are_even(write, tmp_path):
    time, position = strokes(4000)
    lines = rows_of(1.7e9 + time, position, stamp="%.6f")
    assert not simulate("k06-fig10", write([HEADER, *lines]), tmp_path / "out.csv").resampled


def test_a_motion_at_another_rate_is_resampled_linearly_with_a_note(write, tmp_path):
    time, position = strokes(1000, rate=1000)
    summary = simulate("k06-fig10", write([HEADER, *rows_of(time, position)]), tmp_path / "out.csv")
    assert summary.notes == [
        "the motion is sampled at 1000 Hz, the servo runs at 1600 Hz: the motion was resampled linearly"
    ]
    assert summary.resampled and summary.samples == 1000
    new = np.arange(1599) / 1600
    there = np.column_stack([np.interp(new, time, column) for column in position.T])
    result = table(tmp_path / "out.csv", ["time_s", "x_m", "y_m", "z_m", "fy_N"])
    np.testing.assert_allclose(result["time_s"], new, rtol=0, atol=1e-12)
    np.testing.assert_allclose(result["y_m"], there[:, 1], rtol=0, atol=1e-12)
    force = Insertion(load_scene("k06-fig10")).run(there, [0, -1, 0]).force[:, 1]
    np.testing.assert_allclose(result["fy_N"], force, rtol=0, atol=1e-8)


def test_directions_are_resampled_and_stay_of_length_one(write, tmp_path):
    time, position = strokes(500, rate=500)
    axis = np.column_stack((np.sin(time), -np.cos(time), 0 * time)) * 3
    simulate("k06-fig11", write([AXIS_HEADER, *rows_of(time, position, axis)]), tmp_path / "out.csv")
    result = table(tmp_path / "out.csv", ["time_s", "axis_x", "axis_y", "axis_z"])
    np.testing.assert_allclose(np.hypot(result["axis_x"], result["axis_y"]), 1, rtol=1e-12)
    np.testing.assert_allclose(result["axis_x"], np.sin(result["time_s"]), atol=1e-6)


@pytest.mark.parametrize("rows", [2, 301])
def test_ten_rows_a_second_are_enough(write, tmp_path, rows):
    time, position = strokes(rows, rate=10)
    summary = simulate("k06-fig10", write([HEADER, *rows_of(time, position)]), tmp_path / "out.csv")
    assert summary.resampled and summary.ticks == 160 * (rows - 1) + 1


def test_a_slow_motion_is_resampled_in_pieces_of_bounded_size():
    resampler = Resampler(0.0, 100.0, 1 / 1600, 3)
    pieces = list(resampler.add(np.array([[0.0], [1.0], [3.0]])))
    assert max(len(time) for time, _ in pieces) <= 1 << 16
    time, values = (np.concatenate(parts) for parts in zip(*pieces, strict=True))
    assert len(time) == 320_001 and time[-1] == 200.0
    np.testing.assert_allclose(values[:, 0], np.interp(time, [0, 100, 200], [0, 1, 3]), atol=1e-12)


@pytest.mark.parametrize("step", [1 / 1000, 1 / 3000, 1 / 1599, 0.7])
def test_blocks_of_any_size_give_the_same_resampled_motion(step):
    rng = np.random.default_rng(3)
    rows = rng.normal(size=(300, 3))
    whole = list(Resampler(1.5, step, 1 / 1600, 300).add(rows))
    resampler, parts, start = Resampler(1.5, step, 1 / 1600, 300), [], 0
    while start < 300:
        size = int(rng.integers(1, 40))
        parts += list(resampler.add(rows[start : start + size]))
        start += size
    for i in range(2):
        together = np.concatenate([p[i] for p in parts])
        np.testing.assert_allclose(together, np.concatenate([p[i] for p in whole]), rtol=1e-9, atol=1e-9)
    last = np.concatenate([p[0] for p in parts])[-1]
    assert -1e-9 <= 1.5 + 299 * step - last < 1 / 1600 + 1e-9


def test_a_clock_that_is_a_little_off_is_even_and_known_to_be_off(tmp_path):
    even = Evenness(tmp_path)
    time = np.round(np.arange(100_000) / 1600.08, 4)
    for i in range(0, 100_000, 30_000):
        even.add(i + 2, time[i : i + 30_000])
    assert even.step is not None
    assert (even.count, 1 / even.step) == (100_000, pytest.approx(1600.08, abs=5e-3))

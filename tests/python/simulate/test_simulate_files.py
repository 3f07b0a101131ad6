"""Files of any length take the same memory, and an error leaves no file behind."""

import os
import stat
import subprocess
import sys

import pytest
from punctura import load_scene, simulate

from .simulate_motions import HEADER, rows_of, strokes

MEASURE = """
import resource, sys
from punctura import simulate
simulate("k06-fig12", sys.argv[1], sys.argv[2])
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


def peak_kilobytes(motion, out):
    env = os.environ | {"ARROW_DEFAULT_MEMORY_POOL": "system"}  # Arrow's own pool keeps freed memory for a while
    done = subprocess.run(
        [sys.executable, "-c", MEASURE, motion, out], env=env, capture_output=True, text=True, check=True
    )
    return int(done.stdout)


@pytest.mark.skipif(sys.platform != "linux", reason="ru_maxrss is in kilobytes on Linux only")
@pytest.mark.parametrize("suffix", [pytest.param(".csv", marks=pytest.mark.statistics), ".parquet"])
def test_a_motion_five_times_as_long_takes_the_same_memory(write, tmp_path, suffix):
    lines = rows_of(*strokes(100_000), stamp="%.9g")
    short = write([HEADER, *lines], name="short.csv")
    long = tmp_path / "long.csv"
    with long.open("w") as file:
        file.write(HEADER + "\n")
        for repeat in range(5):
            start = repeat * 100_000
            file.writelines(f"{(start + i) / 1600:.9g},{line.split(',', 1)[1]}\n" for i, line in enumerate(lines))
    few = peak_kilobytes(short, tmp_path / f"few{suffix}")
    many = peak_kilobytes(long, tmp_path / f"many{suffix}")
    assert many < few + 15_000, f"{few} kB for 100,000 rows, {many} kB for 500,000"


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
@pytest.mark.parametrize("broken", [RuntimeError, KeyboardInterrupt])
def test_a_run_that_breaks_off_leaves_the_old_result_alone(write, tmp_path, monkeypatch, suffix, broken):
    motion, out = write([HEADER, *rows_of(*strokes(5000))]), tmp_path / f"out{suffix}"
    monkeypatch.setattr("punctura.simulation.motion_file.BLOCK_BYTES", 20_000)
    out.write_text("the old result")

    def tell(share):
        if share > 0.5:
            raise broken

    with pytest.raises(broken):
        simulate("k06-fig10", motion, out, tell)
    assert out.read_text() == "the old result"
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(["motion.csv", out.name])


def test_the_result_has_the_permissions_of_an_ordinary_file(write, tmp_path):
    (tmp_path / "ordinary").touch()
    simulate("k06-fig10", write([HEADER, *rows_of(*strokes(10))]), tmp_path / "out.csv")
    assert stat.S_IMODE((tmp_path / "out.csv").stat().st_mode) == stat.S_IMODE((tmp_path / "ordinary").stat().st_mode)


def test_numbers_in_the_csv_read_back_as_the_same_doubles(write, tmp_path):
    time, position = strokes(3000)
    simulate(load_scene("k06-fig11"), write([HEADER, *rows_of(time, position)]), tmp_path / "out.csv")
    for line, t in zip((tmp_path / "out.csv").read_text().splitlines()[1:], time, strict=True):
        fields = line.split(",")[:-1]
        assert float(fields[0]) == t
        assert all(len(field.lstrip("-0.").split("e")[0].replace(".", "")) <= 17 for field in fields)


def test_a_motion_in_millimetres_is_noted(write, tmp_path):
    time, position = strokes(1000)
    right = simulate("k06-fig10", write([HEADER, *rows_of(time, position)]), tmp_path / "out.csv")
    wrong = simulate("k06-fig10", write([HEADER, *rows_of(time, 1e3 * position)]), tmp_path / "out.csv")
    assert right.notes == []
    assert len(wrong.notes) == 1 and "m deep into 'thin membrane'" in wrong.notes[0]

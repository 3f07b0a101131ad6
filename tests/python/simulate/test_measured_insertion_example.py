"""Runs examples/measured_insertion.py on an artificial trace; the measured data are not needed."""

import subprocess
import sys
from pathlib import Path

import numpy as np

EXAMPLE = Path(__file__).parents[3] / "examples" / "measured_insertion.py"


def run(*arguments):
    return subprocess.run([sys.executable, EXAMPLE, *map(str, arguments)], capture_output=True, text=True)


def test_an_irregular_trace_with_repeated_instants_becomes_a_picture(tmp_path):
    time = np.repeat(np.sort(np.random.default_rng(2).uniform(0, 3, 200)), 2)
    time[0] = 0.0
    rows = np.column_stack((time, 0.3 * np.sin(time), np.zeros_like(time)))
    np.savetxt(tmp_path / "Data1_merged_t_x_F.csv", rows, delimiter=",", header="time_s,displacement_asgiven_m,force_N")
    done = run(tmp_path, "--out", tmp_path / "picture.png")
    assert done.returncode == 0, done.stderr
    assert "rms difference" in done.stdout
    assert (tmp_path / "picture.png").read_bytes().startswith(b"\x89PNG")


def test_a_folder_without_the_trace_is_reported(tmp_path):
    done = run(tmp_path)
    assert done.returncode == 2 and f"there is no Data1_merged_t_x_F.csv in {tmp_path}" in done.stderr

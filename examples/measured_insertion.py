"""Compares the model's force with a measured one: runs punctura simulate on a needle insertion into bovine liver.

    python examples/measured_insertion.py FOLDER [--scene SCENE] [--out measured_insertion.png]

FOLDER holds Data1_merged_t_x_F.csv (time s, displacement m, force N), digitised by others from a figure of Okamura,
Simone and O'Leary, IEEE TBME 51(10), 2004: an 18 G needle goes in, rests for 7.7 s, and comes out. The data have no
licence and are not part of Punctura. Their displacement reaches 0.30 m; it is taken as ten times too large.

The scene is examples/bovine_liver.toml.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray

FILE = "Data1_merged_t_x_F.csv"
AXIS_TOO_LARGE = 10.0
RATE_HZ = 1600.0

Array = NDArray[Any]


def read_measurement(folder: Path) -> tuple[Array, Array, Array]:
    """Time (s), displacement (m) and force on the needle (N) of each digitised sample."""
    time, displacement, force = np.loadtxt(folder / FILE, delimiter=",", skiprows=1).T
    time, first = np.unique(time, return_index=True)
    return time, displacement[first] / AXIS_TOO_LARGE, force[first]


def write_motion(path: Path, time: Array, depth: Array) -> None:
    """Writes the insertion along -y, resampled evenly at the servo rate, since the digitised samples are not even."""
    even = np.arange(int(time[-1] * RATE_HZ) + 1) / RATE_HZ
    y = -np.interp(even, time, depth)
    rows = np.column_stack((even, np.zeros_like(y), y, np.zeros_like(y)))
    np.savetxt(path, rows, delimiter=",", header="time_s,x_m,y_m,z_m", comments="", fmt="%.9g")


def simulate(scene: Path, time: Array, depth: Array) -> Array:
    """Runs punctura simulate on the motion. Returns a table with named columns."""
    with tempfile.TemporaryDirectory() as folder:
        motion, out = Path(folder, "motion.csv"), Path(folder, "out.csv")
        write_motion(motion, time, depth)
        command = [sys.executable, "-m", "punctura", "simulate", scene, "--motion", motion, "--out", out]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return np.genfromtxt(out, delimiter=",", names=True, usecols=("time_s", "y_m", "fy_N"))


def draw(path: Path, measured: tuple[Array, Array, Array], model: Array) -> None:
    time, depth, force = measured
    figure, (over_depth, over_time) = plt.subplots(1, 2, figsize=(12, 4.8), layout="constrained", sharey=True)
    over_depth.plot(depth * 1e3, force, color="0.6", lw=2.5, label="measured (Okamura et al. 2004, digitised)")
    over_depth.plot(-model["y_m"] * 1e3, model["fy_N"], color="C3", lw=1, label="K06, exact solver")
    over_depth.set(xlabel="displacement of the needle (axis divided by 10), mm", ylabel="force on the needle, N")
    over_depth.legend()
    over_time.plot(time, force, color="0.6", lw=2.5)
    over_time.plot(model["time_s"], model["fy_N"], color="C3", lw=1)
    over_time.set(xlabel="time, s")
    for axes in (over_depth, over_time):
        axes.grid(alpha=0.3)
    figure.savefig(path, dpi=150)


def main() -> None:
    parser = argparse.ArgumentParser(description="Compares the model's force with a measured one.")
    parser.add_argument("folder", type=Path, help=f"folder with the file {FILE}")
    parser.add_argument("--scene", type=Path, default=Path(__file__).with_name("bovine_liver.toml"))
    parser.add_argument("--out", type=Path, default=Path("measured_insertion.png"))
    arguments = parser.parse_args()
    if not (arguments.folder / FILE).is_file():
        parser.error(f"there is no {FILE} in {arguments.folder}")

    measured = read_measurement(arguments.folder)
    model = simulate(arguments.scene, *measured[:2])
    draw(arguments.out, measured, model)

    at_samples = np.interp(measured[0], model["time_s"], model["fy_N"])
    print(f"{arguments.out}: rms difference {np.sqrt(np.mean((at_samples - measured[2]) ** 2)):.3f} N")


if __name__ == "__main__":
    main()

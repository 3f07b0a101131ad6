"""Measures when a membrane pops, for both solvers and for sub-steps, against ticks that are 1000 times finer.

python benchmarks/pop_time.py [--check] [--write]      # --write puts the table into docs/pop-time.md
"""

import argparse
import re
import sys
from pathlib import Path

import numpy as np
import numpy.typing as npt
import punctura
from punctura import Insertion, Proxy1d, Scene, ThickLaw

Array = npt.NDArray[np.float64]
DOC = Path(__file__).resolve().parent.parent / "docs" / "pop-time.md"
THICKNESSES_MM = (0.05, 0.1, 0.2, 0.5)
SPEEDS_MM_PER_S = (2, 5, 10, 20)
METHODS = (("paper", 1), ("exact", 1), ("exact", 2), ("exact", 4), ("exact", 8), ("exact", 16))
FINER = 1000
PHASES = 16  # of the ticks against the motion
RATE = 1600.0
MOST_ERROR_MS = 0.3  # for exact with 8 sub-steps


def scene(thickness: float, solver: str, sub_steps: int) -> Scene:
    """K06 section 4 with one membrane of this thickness (m), without a filter."""
    base = punctura.load_scene("k06-fig10").with_values({"membrane[0].thickness": thickness})
    return base.replace(servo=base.servo.replace(solver=solver, sub_steps=sub_steps, low_pass=0.0, rate=RATE))


def half_fall(times: Array, force: Array) -> float:
    """When the force is half-way down from its peak to the plateau, s; straight lines between the ticks."""
    peak, plateau = int(np.argmax(force)), float(force[-1])
    middle = (force[peak] + plateau) / 2
    after = peak + int(np.argmax(force[peak:] <= middle))
    before = after - 1
    share = (force[before] - middle) / (force[before] - force[after])
    return float(times[before] + share * (times[after] - times[before]))


def path(thickness: float, speed: float, rate: float, phase: float) -> tuple[Array, Array]:
    """Times (s) and depths (m) of a steady motion from 0.2 mm in front of the membrane to 2 mm behind the pop."""
    s = scene(thickness, "exact", 1)
    law = ThickLaw(s.needle, s.membranes[0].membrane)
    end = (law.X + thickness + 3.5e-3) / speed
    ticks = np.arange(int((end + 0.2e-3 / speed) * rate), dtype=np.float64)
    times: Array = (ticks + phase) / rate - 0.2e-3 / speed
    return times, speed * times


def reference(thickness: float, speed: float) -> float:
    """When the membrane pops with ticks that are FINER times shorter, s."""
    s = scene(thickness, "exact", 1)
    proxy = Proxy1d(ThickLaw(s.needle, s.membranes[0].membrane), s.coupling, 1 / (RATE * FINER))
    times, depths = path(thickness, speed, RATE * FINER, 0.0)
    chunks = np.array_split(depths, 1 + len(depths) // 100_000)  # a run keeps all columns of its ticks
    return half_fall(times, -np.concatenate([np.asarray(proxy.run(chunk)["force"]) for chunk in chunks]))


def error(thickness: float, speed: float, solver: str, sub_steps: int, right: float) -> float:
    """The mean over the phases of the time of the pop, less the right one, s. Negative is early."""
    found = []
    for phase in range(PHASES):
        insertion = Insertion(scene(thickness, solver, sub_steps))
        times, depths = path(thickness, speed, RATE, phase / PHASES)
        positions = np.outer(-depths, [0.0, 1.0, 0.0])
        force = np.asarray(insertion.run(positions, [0.0, -1.0, 0.0])["force"])[:, 1]
        found.append(half_fall(times, force) - right)
    return float(np.mean(found))


def table() -> tuple[list[str], dict[tuple[str, int], dict[float, float]]]:
    """The lines of the table, and the largest error (ms) of each method by thickness (mm)."""
    worst: dict[tuple[str, int], dict[float, float]] = {method: {} for method in METHODS}
    name = {method: method[0] + (f", {method[1]} sub-steps" if method[1] > 1 else "") for method in METHODS}
    lines = ["| thickness, mm | speed, mm/s | " + " | ".join(name.values()) + " |", "|" + "---|" * (2 + len(METHODS))]
    for thickness in THICKNESSES_MM:
        for speed in SPEEDS_MM_PER_S:
            right = reference(1e-3 * thickness, 1e-3 * speed)
            found = {m: 1e3 * error(1e-3 * thickness, 1e-3 * speed, *m, right) for m in METHODS}
            for method, ms in found.items():
                worst[method][thickness] = max(worst[method].get(thickness, 0.0), abs(ms))
            lines.append(f"| {thickness:g} | {speed} | " + " | ".join(f"{ms:+.2f}" for ms in found.values()) + " |")
    return lines, worst


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="fails if 8 sub-steps are off by more than 0.3 ms")
    parser.add_argument("--write", action="store_true", help="puts the table into docs/pop-time.md")
    given = parser.parse_args()
    lines, worst = table()
    print("\n".join(lines))
    if given.write:
        marked = re.compile(r"(<!-- pop-time table -->\n).*?(\n<!-- end -->)", re.DOTALL)
        text = DOC.read_text(encoding="utf-8")
        DOC.write_text(marked.sub(lambda m: m[1] + "\n" + "\n".join(lines) + "\n" + m[2], text), encoding="utf-8")
    largest = max(worst["exact", 8].values())
    print(f"exact with 8 sub-steps: at most {largest:.2f} ms")
    return int(given.check and largest > MOST_ERROR_MS)


if __name__ == "__main__":
    sys.exit(main())

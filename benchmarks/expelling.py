"""Searches for motions from which a wall that expels the needle gives net work in sampled time: docs/passivity.md.

    python benchmarks/expelling.py [--json FILE]        three minutes of a processor

Each row is the worst found by a search over needles, walls of K06, couplings and vibrations across the pop at 1600 Hz:
the net work on the hand over a closed way from outside to outside, as a share of the work that was exchanged, the sum
of |f dp|. Negative: work is lost on each way that was tried. Without the steps of time none can be positive.
"""

import argparse
import json
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
import punctura as pn
from numpy.typing import NDArray
from scipy.optimize import differential_evolution

T = 1 / 1600
OUTSIDE = -3e-3  # m
Solver = Literal["exact", "paper"]
SOLVERS: tuple[Solver, ...] = ("exact", "paper")
Bounds = list[tuple[float, float]]


def logarithms(*pairs: tuple[float, float]) -> Bounds:
    return [(float(np.log(low)), float(np.log(high))) for low, high in pairs]


# Amplitude (m) and frequency (Hz), logarithms; where the hand vibrates, 0 to 1.
VIBRATION = [*logarithms((1e-4, 5e-3), (0.5, 400)), (0.0, 1.0)]
# Diameter and thickness (m), stiffness of wall and coupling (N/m), logarithms; tip angle (rad), precompression (N),
# damping of the coupling (N s/m).
WALL = [*logarithms((3e-4, 2e-3), (1e-5, 4e-3), (50, 3000), (100, 4000)), (0.1, 0.6), (0.0, 1.0), (0.0, 2.0)]


def closed(path: NDArray[np.float64]) -> NDArray[np.float64]:
    """The path with slow ways (20 mm/s) from outside and back, and a rest at the end."""

    def way(a: float, b: float) -> NDArray[np.float64]:
        return np.linspace(a, b, max(50, int(abs(b - a) / 0.02 / T)))

    back = way(path[-1], 2 * OUTSIDE), way(2 * OUTSIDE, OUTSIDE)
    return np.concatenate([np.full(5, OUTSIDE), way(OUTSIDE, path[0]), path, *back, np.full(300, OUTSIDE)])


class Wall(NamedTuple):
    needle: pn.Needle
    membrane: pn.Membrane
    coupling: pn.Coupling

    def given(self, vibration: NDArray[np.float64], speed: float, solver: Solver) -> float:
        """The share of net work for the values of VIBRATION. speed: the hand's greatest, m/s."""
        amplitude, frequency, place = np.exp(vibration[0]), np.exp(vibration[1]), vibration[2]
        amplitude = min(amplitude, speed / (2 * np.pi * frequency))
        law = pn.ThickLaw(self.needle, self.membrane)
        tip, thickness = self.needle.diameter / np.tan(self.needle.tip_angle), self.membrane.thickness
        peak = -law.bounds(np.linspace(0, tip + thickness, 100))[0].min()
        pop = tip + (place - 0.5) * (thickness + tip) + peak / self.coupling.stiffness
        p = closed(pop + amplitude * np.sin(2 * np.pi * frequency * T * np.arange(round(2 / T))))
        force = pn.Proxy1d(law, self.coupling, period=T, solver=solver).run(p).force
        work = force * np.diff(p, prepend=p[0])
        exchanged = np.abs(work).sum()
        return float(work.sum() / exchanged) if exchanged > 1e-6 else -1.0  # the needle met no wall


def worst(bounds: Bounds, wall: Callable[[NDArray[np.float64]], Wall], speed: float, solver: Solver) -> float:
    """The largest share of net work; `wall` makes the wall of the values behind those of the vibration."""

    def lost(values: NDArray[np.float64]) -> float:
        return -wall(values[3:]).given(values[:3], speed, solver)

    return -float(differential_evolution(lost, bounds, maxiter=30, popsize=8, seed=1, polish=False, tol=0).fun)


def any_wall(friction: float) -> Callable[[NDArray[np.float64]], Wall]:
    """The walls of the values of WALL. friction: mu / tan(theta)."""

    def wall(values: NDArray[np.float64]) -> Wall:
        diameter, thickness, stiffness, coupling = np.exp(values[:4])
        angle, precompression, damping = values[4:]
        needle, mu = pn.Needle(diameter, angle), friction * np.tan(angle)
        return Wall(needle, pn.Membrane(stiffness, precompression, mu, thickness), pn.Coupling(coupling, damping))

    return wall


def walls() -> Iterator[tuple[str, Bounds, Callable[[NDArray[np.float64]], Wall]]]:
    for friction in (0.001, 0.02, 0.05, 0.1, 0.2, 0.4):
        yield f"{friction:g}", VIBRATION + WALL, any_wall(friction)
    scene = pn.load_scene("venipuncture")
    vein = Wall(scene.needle, scene.membranes[1].membrane, scene.coupling)
    share = vein.membrane.friction / np.tan(vein.needle.tip_angle)
    yield f"{share:.2f}: a vein wall of venipuncture", VIBRATION, lambda _: vein


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", type=Path, metavar="FILE")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore", UserWarning)  # the search meets unusual numbers
    rows = []
    print("| mu / tan(theta) | greatest speed | exact | paper |\n|---|---|---|---|")
    for name, bounds, wall in walls():
        for speed in (0.1, 1.0):
            exact, paper = (worst(bounds, wall, speed, solver) for solver in SOLVERS)
            rows.append({"wall": name, "speed_m_per_s": speed, "exact": exact, "paper": paper})
            print(f"| {name} | {speed:g} m/s | {exact:.0%} | {paper:.0%} |", flush=True)
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=2) + "\n")


if __name__ == "__main__":
    main()

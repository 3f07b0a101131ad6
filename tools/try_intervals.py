"""Measures how often the intervals of `punctura identify` hold the truth.

    python tools/try_intervals.py [--traces 1000] [--noise 0.01] [--correlation 0] [--processes 2] [--seed 1]

Each trace is a random membrane behind a random spring, felt by a simulated hand at a simulated device (plant and
tremor), sampled at 200 Hz, with noise of the force sensor. --correlation: of the noise from sample to sample (AR(1)).
An interval of 95 % should hold the truth in 93 to 97 % of the traces. It takes about 1 s of a processor a trace.
"""

from __future__ import annotations

import argparse
import multiprocessing
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from functools import partial

import numpy as np
import punctura as pn
from punctura.identify import identify
from punctura.trace import Trace

RATE_HZ = 200
Row = tuple[str, bool, bool]  # parameter, identifiable, the interval holds the truth


def random_trace(seed: int, noise: float, correlation: float) -> tuple[Trace, pn.Needle, dict[str, float]]:
    """A trace, the needle, and the true values."""
    rng = np.random.default_rng(seed)
    needle = pn.Needle(rng.uniform(0.6e-3, 1.6e-3), rng.uniform(0.25, 0.6))
    tip = needle.diameter / np.tan(needle.tip_angle)
    truth = {
        "stiffness": rng.uniform(200, 900), "precompression": rng.uniform(0.05, 0.4), "friction": rng.uniform(0.1, 0.4),
        "thickness": rng.uniform(0.1, 0.5) * tip, "coupling_stiffness": rng.uniform(1500, 6000),
    }  # fmt: skip
    wall = pn.Membrane(*(truth[name] for name in ("stiffness", "precompression", "friction", "thickness")))
    placed = pn.PlacedMembrane("wall", wall, (0, 0, 0), (0, -1, 0))
    scene = pn.Scene(
        "random",
        needle, pn.Coupling(truth["coupling_stiffness"], 0.01), [placed],
        servo=pn.ServoSettings(low_pass=0),
    )  # fmt: skip
    deepest = 1.6 * tip + truth["thickness"] + 1e-3
    strokes = pn.Strokes((0, 2e-3, 0), (0, -deepest, 0), count=1, duration=2.0, rest=0.4, variation=0)
    ticks = pn.Experiment(scene, strokes, seed=seed).run(strokes.duration_for(seed))[:: int(1600 / RATE_HZ)]
    sensor = rng.normal(size=len(ticks.time))
    for i in range(1, len(sensor)):
        sensor[i] = correlation * sensor[i - 1] + np.sqrt(1 - correlation**2) * sensor[i]
    force = np.asarray(ticks.force[:, 1]) + noise * sensor
    return Trace(-ticks.position[:, 1] + 2e-3, force, ticks.time), needle, truth | {"surface": 2e-3}


def tried(seed: int, noise: float, correlation: float) -> list[Row]:
    """One row for each parameter of one trace."""
    trace, needle, truth = random_trace(seed, noise, correlation)
    rows = []
    for estimate in identify(trace, needle, membranes=1).estimates:
        kind = estimate.name.rpartition(".")[2]
        if kind in truth:
            low = -np.inf if estimate.low is None else estimate.low
            high = np.inf if estimate.high is None else estimate.high
            rows.append((kind, estimate.identifiable, bool(low <= truth[kind] <= high)))
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--traces", type=int, default=1000)
    parser.add_argument("--noise", type=float, default=0.01, help="N")
    parser.add_argument("--correlation", type=float, default=0.0)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    seeds = range(given.seed, given.seed + given.traces)
    with ProcessPoolExecutor(given.processes, multiprocessing.get_context("spawn")) as pool:
        work = pool.map(partial(tried, noise=given.noise, correlation=given.correlation), seeds)
        rows = [row for found in work for row in found]
    told, held = Counter(r[0] for r in rows if r[1]), Counter(r[0] for r in rows if r[1] and r[2])
    all_of = Counter(r[0] for r in rows)
    for kind, count in all_of.items():
        share = f"{100 * held[kind] / told[kind]:5.1f} %" if told[kind] else "-"
        print(f"{kind:20} {share} of {told[kind]:5} intervals hold the truth; not identifiable: {count - told[kind]}")
    print(f"{'all':20} {100 * sum(held.values()) / max(sum(told.values()), 1):5.1f} % of {sum(told.values()):5}")


if __name__ == "__main__":
    main()

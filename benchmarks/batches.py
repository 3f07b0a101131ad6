"""Measures batches of proxies on a line: against the core tick by tick, and against NumPy, Numba and JAX.

python benchmarks/batches.py [--json FILE] [--seconds S] [--program FILE]

Numba and JAX are compared if they are installed. docs/performance.md has the figures.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from batch_rows import batch_table, measure_batches
from program import ROOT, ProgramError, build
from punctura import Coupling, LineBatch, Membrane, Needle, ThickLaw
from rival_batches import Array, constants, jax_batch, motion, numba_batch, numpy_batch
from run import machine, versions

PERIOD, STIFFNESS, DAMPING = 1 / 1600, 400.0, 1.0
TRIALS, TICKS = 1024, 800
NUMBA_LANES = (32, 128, 1024)


def rivals() -> dict[str, Any]:
    """ns of processor time per trial and tick with the paper's solver, in interleaved rounds."""
    needle = Needle(diameter=1.08e-3, tip_angle=0.28)
    walls = np.linspace(0.3e-3, 1e-3, TRIALS)
    laws = [ThickLaw(needle, Membrane(stiffness=570, precompression=0.41, friction=0.2, thickness=h)) for h in walls]
    p, known = motion(TICKS, TRIALS, PERIOD), constants(laws, STIFFNESS, DAMPING, PERIOD)
    batch = LineBatch(laws, Coupling(stiffness=STIFFNESS, damping=DAMPING), PERIOD, "paper")
    out = np.empty_like(p)

    def ours() -> Array:
        batch.reset()
        return batch.run(p, out=out, threads=1)

    contestants: dict[str, Callable[[], Array]] = {"LineBatch": ours, "NumPy": lambda: numpy_batch(p, known)}
    if find_spec("numba"):
        for lanes in NUMBA_LANES:
            run = numba_batch(lanes)
            contestants[f"Numba, {lanes} lanes"] = lambda run=run: run(p, known)  # type: ignore[misc]
    if find_spec("jax"):
        scan = jax_batch()
        contestants["JAX"] = lambda: scan(p, known)
    expected = ours().copy()
    for name, run in contestants.items():
        if not (worst := float(np.max(np.abs(run() - expected)))) <= 1e-9:
            raise ProgramError(f"{name} and LineBatch differ by {worst:.3g} N")
    rounds: dict[str, list[float]] = {name: [] for name in contestants}
    for _ in range(7):
        for name, run in contestants.items():
            start = time.process_time_ns()
            run()
            rounds[name].append((time.process_time_ns() - start) / p.size)
    ns = {name: statistics.median(times) for name, times in rounds.items()}
    over = {name: statistics.median(np.divide(times, rounds["LineBatch"])) for name, times in rounds.items()}
    return {name: {"median_ns": ns[name], "fastest_ns": min(rounds[name]), "over_batch": over[name]} for name in ns}


def table(result: dict[str, Any]) -> list[str]:
    lines = batch_table(result)
    lines.append(
        f"Transcriptions, paper, {TRIALS} trials, {TICKS} ticks: median (fastest); times the time of LineBatch"
    )
    for name, t in result["rivals"].items():
        lines.append(f"    {name:17} {t['median_ns']:7.2f} ({t['fastest_ns']:6.2f}) {t['over_batch']:6.2f}")
    return lines


def main() -> int:
    parser = argparse.ArgumentParser(description="Measures batches against the scalar core and other tools.")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all results and the machine's data")
    parser.add_argument("--seconds", type=float, default=4, help="seconds for each row (default %(default)s)")
    parser.add_argument("--program", type=Path, metavar="FILE", help="bench_batch, if it is already built")
    options = parser.parse_args()
    try:
        program = options.program or build(ROOT / "build/bench", "bench_batch")
        measured = measure_batches(program, options.seconds)
        result = {"machine": machine(), "versions": versions()} | measured | {"rivals": rivals()}
    except ProgramError as error:
        print(error, file=sys.stderr)
        return 3
    print("\n".join(table(result)))
    if options.json:
        options.json.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""LineBatch against NumPy, Numba and JAX: the same trials, the same forces."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from typing import Any

import numpy as np
from program import ProgramError
from punctura import Coupling, LineBatch, Membrane, Needle, ThickLaw
from rival_batches import Array, constants, jax_batch, motion, numba_batch, numpy_batch

PERIOD, STIFFNESS, DAMPING = 1 / 1600, 400.0, 1.0
TRIALS, TICKS = 1024, 800
NUMBA_LANES = (32, 128, 1024)


def measure_rivals() -> dict[str, Any]:
    """ns of processor time per trial and tick with the paper's solver, in interleaved rounds.

    Numba and JAX are measured if they are installed.
    """
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


def rivals_table(rivals: dict[str, Any]) -> Iterator[str]:
    yield f"Transcriptions, paper, {TRIALS} trials, {TICKS} ticks: median (fastest); times the time of LineBatch"
    for name, t in rivals.items():
        yield f"    {name:17} {t['median_ns']:7.2f} ({t['fastest_ns']:6.2f}) {t['over_batch']:6.2f}"
    missing = [name for name in ("Numba", "JAX") if not any(each.startswith(name) for each in rivals)]
    if missing:
        yield f"    {' and '.join(missing)}: not installed (pip install numba jax)"

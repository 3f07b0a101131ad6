"""LineBatch against NumPy, Numba and JAX: the same trials, the same forces."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator
from functools import partial
from importlib.util import find_spec
from typing import Any, Literal

import numpy as np
from program import ProgramError
from punctura import Coupling, Membrane, Needle, ThickLaw
from punctura.batches import LineBatch
from rival_batches import Array, Constants, constants, jax_batch, motion, numba_batch, numpy_batch
from rival_exact import jax_exact, numba_exact

PERIOD, STIFFNESS, DAMPING = 1 / 1600, 400.0, 1.0
TRIALS, TICKS = 1024, 800
NUMBA_LANES = (32, 128, 1024)


Run = Callable[[Array, Constants], Array]


def measure_rivals() -> dict[str, dict[str, Any]]:
    """ns of processor time per trial and tick with each solver, in interleaved rounds.

    Numba and JAX are measured if they are installed. NumPy has no transcription of the exact solver.
    """
    return {
        "paper": _measured("paper", {"NumPy": numpy_batch}, numba_batch, jax_batch),
        "exact": _measured("exact", {}, numba_exact, jax_exact),
    }


def _measured(
    solver: Literal["exact", "paper"], runs: dict[str, Run], numba: Callable[[int], Run], jax: Callable[[], Run]
) -> dict[str, Any]:
    needle = Needle(diameter=1.08e-3, tip_angle=0.28)
    walls = np.linspace(0.3e-3, 1e-3, TRIALS)
    laws = [ThickLaw(needle, Membrane(stiffness=570, precompression=0.41, friction=0.2, thickness=h)) for h in walls]
    p, known = motion(TICKS, TRIALS, PERIOD), constants(laws, STIFFNESS, DAMPING, PERIOD)
    batch = LineBatch(laws, Coupling(stiffness=STIFFNESS, damping=DAMPING), PERIOD, solver)
    out = np.empty_like(p)

    def ours() -> Array:
        batch.reset()
        return batch.run(p, out=out, threads=1)

    runs = dict(runs)
    if find_spec("numba"):
        runs |= {f"Numba, {lanes} lanes": numba(lanes) for lanes in NUMBA_LANES}
    if find_spec("jax"):
        runs["JAX"] = jax()
    contestants: dict[str, Callable[[], Array]] = {"LineBatch": ours}
    contestants |= {name: partial(run, p, known) for name, run in runs.items()}
    expected = ours().copy()
    for name, run in contestants.items():
        if not (worst := float(np.max(np.abs(run() - expected)))) <= 1e-9:
            raise ProgramError(f"{name} and LineBatch differ by {worst:.3g} N with the solver {solver}")
    rounds: dict[str, list[float]] = {name: [] for name in contestants}
    for _ in range(7):
        for name, run in contestants.items():
            start = time.process_time_ns()
            run()
            rounds[name].append((time.process_time_ns() - start) / p.size)
    ns = {name: statistics.median(times) for name, times in rounds.items()}
    over = {name: statistics.median(np.divide(times, rounds["LineBatch"])) for name, times in rounds.items()}
    return {name: {"median_ns": ns[name], "fastest_ns": min(rounds[name]), "over_batch": over[name]} for name in ns}


def rivals_table(rivals: dict[str, dict[str, Any]]) -> Iterator[str]:
    for solver, rows in rivals.items():
        yield f"Transcriptions, {solver}, {TRIALS} trials, {TICKS} ticks: median (fastest); times the time of LineBatch"
        for name, t in rows.items():
            yield f"    {name:17} {t['median_ns']:7.2f} ({t['fastest_ns']:6.2f}) {t['over_batch']:6.2f}"
    names = [name for rows in rivals.values() for name in rows]
    missing = [name for name in ("Numba", "JAX") if not any(each.startswith(name) for each in names)]
    if missing:
        yield f"    {' and '.join(missing)}: not installed (pip install numba jax)"

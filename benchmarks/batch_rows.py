"""The rows of many trials at once: measured by bench_batch, printed as text."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

from program import ProgramError


def measure_batches(program: Path, seconds: float) -> dict[str, Any]:
    """Runs bench_batch, `seconds` for each row."""
    done = subprocess.run([str(program), "--seconds", str(seconds)], stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise ProgramError(f"{program.name} ended with {done.returncode}; see its message above")
    result: dict[str, Any] = json.loads(done.stdout)
    return result


def batch_table(result: dict[str, Any]) -> list[str]:
    """result: of measure_batches()."""
    lines = ["Many trials: ns per trial and tick, processor time of one thread: median (fastest); times faster"]
    for row in result["rows"]:
        lines.append(f"  proxies on a line, {row['solver']}, {row['trials']} trials, {row['ticks']} ticks")
        lines += _contestants(row["contestants"])
    for row in result["hands"]:
        lines.append(
            f"  a simulated hand, a wall of {row['wall']}, {row['solver']}, one second at 1600 Hz; core is Experiment"
        )
        lines += _contestants(row["contestants"])
    lines.append("  two threads: wall-clock ns per trial and tick with one, with two (fastest rounds); times faster;")
    lines.append("  times faster on two free processors, from the processor time of all threads")
    for row in result["threads"]:
        times, free = row["one_ns"] / row["two_ns"], 2 * row["one_computed_ns"] / row["two_computed_ns"]
        lines.append(
            f"    {row['what']:5} {row['solver']:6} {row['one_ns']:7.2f} {row['two_ns']:7.2f} {times:6.2f} {free:6.2f}"
        )
    lines.append(f"  bytes for each trial: {result['bytes_per_trial']}, and its law")
    return lines


def _contestants(contestants: dict[str, Any]) -> list[str]:
    return [
        f"    {name:9} {t['median_ns']:7.2f} ({t['fastest_ns']:6.2f}) {t['times_faster']:6.2f}"
        for name, t in contestants.items()
    ]

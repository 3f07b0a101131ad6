"""The rows of many trials at once: measured by bench_batch, printed as text."""

import json
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

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
    lines += _threads(result["threads"])
    lines.append(f"  bytes for each trial: {result['bytes_per_trial']}, and its law")
    return [*lines, *_growth(result["growth"]), *_roofline(result)]


def _threads(rows: list[dict[str, Any]]) -> Iterator[str]:
    yield "  threads: wall-clock ns per trial and tick (fastest rounds); times faster than one thread;"
    yield "  times faster if each has a free processor, from the processor time of all threads"
    for row in rows:
        one = row["counts"][0]
        for n in row["counts"]:
            faster, free = one["wall_ns"] / n["wall_ns"], n["threads"] * one["computed_ns"] / n["computed_ns"]
            what = f"{row['what']:5} {row['solver']:6} {n['threads']:4}"
            yield f"    {what} {n['wall_ns']:7.2f} {faster:6.2f} {free:6.2f}"


def _growth(growth: dict[str, Any]) -> Iterator[str]:
    yield "  growth, fastest rounds. Proxies on a line, paper: trials x ticks, ns per trial and tick"
    for trials, ticks, ns in growth["line"]:
        yield f"    {trials:6} x {ticks:6} {ns:7.2f}"
    yield "  a simulated hand, exact: membranes, ns per trial and tick"
    for membranes, ns in growth["membranes"]:
        yield f"    {membranes:6} {ns:16.1f}"


class Roof(NamedTuple):
    """What an instruction set reaches in a row, of what it can reach at most."""

    code: str
    solver: str
    trials: int
    operations_per_ns: float
    most_operations_per_ns: float
    bytes_per_ns: float
    most_bytes_per_ns: float


def roofs(result: dict[str, Any]) -> list[Roof]:
    """For the rows of proxies on a line, fastest rounds."""
    peak = result["peak"]
    return [
        Roof(
            code,
            row["solver"],
            row["trials"],
            peak["operations"][row["solver"]]["all"] / ns,
            most,
            peak["line_bytes"] / ns,
            peak["copied_bytes_per_ns"],
        )
        for row in result["rows"]
        for code, most in peak["operations_per_ns"].items()
        for ns in [row["contestants"][code]["fastest_ns"]]
    ]


def _roofline(result: dict[str, Any]) -> Iterator[str]:
    peak = result["peak"]
    yield f"  roofline. A trial and tick reads and writes {peak['line_bytes']} bytes. Its vector operations, counted:"
    for solver, counts in peak["operations"].items():
        parts = ", ".join(f"{name.replace('_', '/')} {count:.1f}" for name, count in counts.items() if name != "all")
        yield f"    {solver:6} {counts['all']:5.1f}: {parts}"
    yield "    each ns: operations, of the measured peak (products and sums); bytes, of those of a copy in memory"
    for roof in roofs(result):
        computed, moved = roof.operations_per_ns, roof.bytes_per_ns
        yield (
            f"    {roof.solver:6} {roof.code:7} {roof.trials:6} trials {computed:6.1f} of "
            f"{roof.most_operations_per_ns:5.1f} ({computed / roof.most_operations_per_ns:4.0%}); {moved:5.1f} of "
            f"{roof.most_bytes_per_ns:5.1f} ({moved / roof.most_bytes_per_ns:4.0%})"
        )


def _contestants(contestants: dict[str, Any]) -> list[str]:
    return [
        f"    {name:9} {t['median_ns']:7.2f} ({t['fastest_ns']:6.2f}) {t['times_faster']:6.2f}"
        for name, t in contestants.items()
    ]

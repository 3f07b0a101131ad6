"""Measures the wake-up latency of servo loop and cyclictest, at the same time on the same CPU. See docs/bench.md."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from program import ProgramError

RATE_HZ, PRIORITY = 1600, 80
SLICE_S = 5.0  # for both on one CPU; the next slice uses the next CPU
WARM_UP_S = 0.2  # before each slice, so that the start of the processes does not count
RESAMPLES = 400
SHARES = {"p50_us": 0.5, "p99_us": 0.99, "p99_9_us": 0.999}

Latencies = NDArray[np.int64]  # ns, one per period


def quantile(latencies: Latencies, share: float) -> float:
    """The smallest measured latency that the given share does not exceed, us."""
    return float(np.quantile(latencies, share, method="inverted_cdf")) / 1e3


def warm(latencies: Latencies) -> Latencies:
    """The latencies after the warm-up."""
    return latencies[round(WARM_UP_S * RATE_HZ) :]


def summary(slices: list[Latencies]) -> dict[str, float]:
    """Quantiles over all slices."""
    pooled = np.concatenate(slices)
    shares = {name: quantile(pooled, share) for name, share in SHARES.items()}
    return shares | {"largest_us": float(pooled.max()) / 1e3, "wake_ups": len(pooled)}


class Slice(NamedTuple):
    """Length, CPU and priority of one slice."""

    seconds: float
    priority: int  # 0: none
    processor: int
    folder: Path

    @property
    def wake_ups(self) -> int:
        return round((WARM_UP_S + self.seconds) * RATE_HZ)


def begin_loop(program: Path, of: Slice) -> Callable[[], tuple[Latencies, dict[str, Any]]]:
    """Starts the servo loop. The returned function waits for its end and returns its latencies and its report."""
    dump = of.folder / "loop.i64"
    command = [program, "--seconds", WARM_UP_S + of.seconds, "--rate", RATE_HZ, "--priority", of.priority]
    where = ["--processor", of.processor, "--dump", dump]
    process = subprocess.Popen([str(word) for word in command + where], stdout=subprocess.PIPE, text=True)

    def end() -> tuple[Latencies, dict[str, Any]]:
        report, _ = process.communicate()
        if process.returncode != 0:
            raise ProgramError(f"{program.name} ended with {process.returncode}; see its message above")
        return warm(np.fromfile(dump, np.int64)), json.loads(report)

    return end


def begin_cyclictest(cyclictest: str, of: Slice) -> Callable[[], Latencies]:
    """Starts cyclictest with one thread. Like the servo loop, it locks its memory and keeps the CPU from sleeping.

    It writes to a file, because the reader of a pipe would keep a CPU busy for cyclictest only.
    """
    scheduling = [f"--priority={of.priority}", "--policy=fifo"] if of.priority else ["--policy=other"]
    how = [
        "--threads=1",
        f"--interval={1_000_000 // RATE_HZ}",
        f"--loops={of.wake_ups}",
        f"--affinity={of.processor}",
        "--mlockall",
        "--nsecs",
        "--verbose",
    ]
    output = of.folder / "cyclictest.txt"
    with output.open("w") as file:
        process = subprocess.Popen([cyclictest, *scheduling, *how], stdout=file, stderr=subprocess.PIPE, text=True)

    def end() -> Latencies:
        _, complaint = process.communicate()
        report = output.read_text()
        if process.returncode != 0:
            raise ProgramError(f"{cyclictest} ended with {process.returncode}: {complaint.strip()[-400:]}")
        # thread: cycle: latency
        latencies = np.array(re.findall(r"^ *0: *\d+: *(\d+)$", report, re.M), np.int64)
        if len(latencies) != of.wake_ups:
            raise ProgramError(
                f"{cyclictest} reported {len(latencies)} of {of.wake_ups} wake-ups; it began: {report[:200]}"
            )
        return warm(latencies)

    return end


def interval(loops: list[Latencies], others: list[Latencies]) -> tuple[float, float]:
    """Quartiles of the pooled ratio by bootstrap: slices of both are resampled."""
    draw = np.random.default_rng(0)

    def ratio() -> float:
        chosen = draw.integers(len(loops), size=len(loops))
        mine, theirs = (np.concatenate([slices[i] for i in chosen]) for slices in (loops, others))
        return quantile(mine, SHARES["p99_9_us"]) / quantile(theirs, SHARES["p99_9_us"])

    low, high = np.quantile([ratio() for _ in range(RESAMPLES)], (0.25, 0.75))
    return float(low), float(high)


def stolen() -> float | None:
    """Processor time that the host of a virtual machine has taken so far, s; None if the system does not report it."""
    try:
        counts = Path("/proc/stat").read_text().split("\n", 1)[0].split()
        return int(counts[8]) / os.sysconf("SC_CLK_TCK")
    except (OSError, IndexError, ValueError):
        return None


@contextmanager
def one_core_busy() -> Iterator[None]:
    spinner = subprocess.Popen([sys.executable, "-c", "while True: pass"])
    try:
        yield
    finally:
        spinner.kill()
        spinner.wait()


@contextmanager
def nothing_else() -> Iterator[None]:
    yield


CONDITIONS: dict[str, Callable[[], Any]] = {"nothing else": nothing_else, "one core busy": one_core_busy}


def measure_wakeups(program: Path, seconds: float) -> dict[str, Any]:
    """Runs both for `seconds` in each condition, in slices on each CPU in turn, so that disturbances affect both."""
    cyclictest = shutil.which("cyclictest")
    processors = sorted(os.sched_getaffinity(0))
    result: dict[str, Any] = {"rate_hz": RATE_HZ, "cyclictest": cyclictest, "processors": processors}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        _, report = begin_loop(program, Slice(0.1, PRIORITY, processors[0], folder))()
        granted = report["realtime"].get(f"SCHED_FIFO real-time priority {PRIORITY}", False)
        result |= {"realtime": report["realtime"], "priority": PRIORITY if granted else 0, "conditions": []}
        count = max(1, round(seconds / SLICE_S))
        where = [processors[i % len(processors)] for i in range(count)]
        slices = [Slice(min(seconds, SLICE_S), result["priority"], processor, folder) for processor in where]
        for condition, going_on in CONDITIONS.items():
            with going_on():
                before = stolen()
                row = _condition(program, cyclictest, slices)
                after = stolen()
            row["stolen_s"] = None if before is None or after is None else after - before
            result["conditions"].append({"name": condition} | row)
            print(".", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return result


def _condition(program: Path, cyclictest: str | None, slices: list[Slice]) -> dict[str, Any]:
    loops: list[Latencies] = []
    others: list[Latencies] = []
    missed = 0
    for of in slices:
        end_other = begin_cyclictest(cyclictest, of) if cyclictest else None
        end_loop = begin_loop(program, of)
        try:
            if end_other:
                others.append(end_other())
        finally:
            latencies, report = end_loop()
        loops.append(latencies)
        missed += report["missed"]
    row: dict[str, Any] = {"loop": summary(loops) | {"missed": missed}}
    if others:
        row["cyclictest"] = summary(others)
        low, high = interval(loops, others)
        row["over_cyclictest"] = {
            "pooled": row["loop"]["p99_9_us"] / row["cyclictest"]["p99_9_us"],
            "lower_quartile": low,
            "upper_quartile": high,
        }
    return row

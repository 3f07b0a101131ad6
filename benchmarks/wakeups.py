"""How late the servo loop wakes, beside cyclictest: at one period and priority, in turn. See docs/bench.md."""

from __future__ import annotations

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
from typing import Any

import numpy as np
from numpy.typing import NDArray
from program import ProgramError

RATE_HZ, PRIORITY = 1600, 80
SLICE_S = 1.0  # of each contestant, in turn
WARM_UP_S = 0.2  # before each slice: what a process does as it begins is not how late a loop wakes
RESAMPLES = 400
SHARES = {"p50_us": 0.5, "p99_us": 0.99, "p99_9_us": 0.999}

Latencies = NDArray[np.int64]  # ns, one a period


def quantile(latencies: Latencies, share: float) -> float:
    """The least latency that so large a share does not exceed, us."""
    return float(np.quantile(latencies, share, method="inverted_cdf")) / 1e3


def warm(latencies: Latencies) -> Latencies:
    """Those after the warm-up."""
    return latencies[round(WARM_UP_S * RATE_HZ) :]


def summary(slices: list[Latencies]) -> dict[str, float]:
    """Of all slices together."""
    pooled = np.concatenate(slices)
    shares = {name: quantile(pooled, share) for name, share in SHARES.items()}
    return shares | {"largest_us": float(pooled.max()) / 1e3, "wake_ups": len(pooled)}


def of_loop(program: Path, seconds: float, priority: int, folder: Path) -> tuple[Latencies, dict[str, Any]]:
    """One slice of the servo loop, and what its program says of it."""
    dump = folder / "loop.i64"
    command = [program, "--seconds", WARM_UP_S + seconds, "--rate", RATE_HZ, "--priority", priority, "--dump", dump]
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise ProgramError(f"{program.name} ended with {done.returncode}; its message stands above")
    return warm(np.fromfile(dump, np.int64)), json.loads(done.stdout)


def of_cyclictest(cyclictest: str, seconds: float, priority: int, folder: Path) -> Latencies:
    """One slice of cyclictest, one thread. Both lock their memory and keep the processor awake.

    It writes to a file: a reader at the other end of a pipe would keep a processor from idling, for this one alone.
    """
    loops = round((WARM_UP_S + seconds) * RATE_HZ)
    scheduling = [f"--priority={priority}", "--policy=fifo"] if priority else ["--policy=other"]
    how = [
        "--threads=1",
        f"--interval={1_000_000 // RATE_HZ}",
        f"--loops={loops}",
        "--mlockall",
        "--nsecs",
        "--verbose",
    ]
    output = folder / "cyclictest.txt"
    with output.open("w") as file:
        done = subprocess.run([cyclictest, *scheduling, *how], stdout=file, stderr=subprocess.PIPE, text=True)
    said = output.read_text()
    if done.returncode != 0:
        raise ProgramError(f"{cyclictest} ended with {done.returncode}: {done.stderr.strip()[-400:]}")
    # thread: cycle: latency
    latencies = np.array(re.findall(r"^ *0: *\d+: *(\d+)$", said, re.M), np.int64)
    if len(latencies) != loops:
        raise ProgramError(f"{cyclictest} reported {len(latencies)} of {loops} wake-ups; it began: {said[:200]}")
    return warm(latencies)


def interval(loops: list[Latencies], others: list[Latencies]) -> tuple[float, float]:
    """Quartiles of the pooled ratio over runs that might have been: slices, with their neighbours, drawn anew."""
    draw = np.random.default_rng(0)

    def ratio() -> float:
        chosen = draw.integers(len(loops), size=len(loops))
        mine, theirs = (np.concatenate([slices[i] for i in chosen]) for slices in (loops, others))
        return quantile(mine, SHARES["p99_9_us"]) / quantile(theirs, SHARES["p99_9_us"])

    low, high = np.quantile([ratio() for _ in range(RESAMPLES)], (0.25, 0.75))
    return float(low), float(high)


def stolen() -> float | None:
    """What the host of a virtual machine has taken from all its processors so far, s; None where nothing says so."""
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
    """`seconds` of each contestant in each condition, in slices that alternate: what else goes on meets both."""
    cyclictest = shutil.which("cyclictest")
    result: dict[str, Any] = {"rate_hz": RATE_HZ, "priority": PRIORITY, "cyclictest": cyclictest, "conditions": []}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        _, said = of_loop(program, 0.1, PRIORITY, folder)
        result["realtime"] = said["realtime"]
        if not said["realtime"].get(f"first-in-first-out priority {PRIORITY}", False):
            result["priority"] = 0  # not granted: then neither gets one
        for condition, going_on in CONDITIONS.items():
            with going_on():
                before = stolen()
                row = _condition(program, cyclictest, seconds, result["priority"], folder)
                after = stolen()
            row["stolen_s"] = None if before is None or after is None else after - before
            result["conditions"].append({"name": condition} | row)
            print(".", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return result


def _condition(program: Path, cyclictest: str | None, seconds: float, priority: int, folder: Path) -> dict[str, Any]:
    loops: list[Latencies] = []
    others: list[Latencies] = []
    missed = 0
    slices = max(1, round(seconds / SLICE_S))
    seconds = min(seconds, SLICE_S)
    for i in range(slices):
        for loops_turn in (True, False) if i % 2 == 0 else (False, True):
            if loops_turn:
                latencies, said = of_loop(program, seconds, priority, folder)
                loops.append(latencies)
                missed += said["missed"]
            elif cyclictest:
                others.append(of_cyclictest(cyclictest, seconds, priority, folder))
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

"""The benchmarks. See docs/bench.md.

Measures the model's ns per tick, compared with a hand-written loop and a NumPy loop, and the wake-up latency of the
servo loop, compared with cyclictest, and many trials at once, in lanes and on two threads.

python benchmarks/run.py [--check] [--json FILE] [--pictures FOLDER] [--seconds S] [--batch-seconds S]
    [--wakeup-seconds S] [--only-batches]
"""

import argparse
import json
import os
import platform
import sys
import tempfile
import time
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
from batch_rows import batch_table, measure_batches
from numpy_loop import LOOPS, Array
from pictures import draw
from program import ROOT, ProgramError, build, call
from ratios import Ratio, all_ratios, over_cyclictest
from table import table, verdicts, wakeup_table
from wakeups import CONDITIONS, measure_wakeups

LOOP_TICKS = 4000  # 2.5 s of motion: one insertion and withdrawal
LOOP_REPETITIONS = 7


def processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def machine() -> dict[str, Any]:
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else None
    return {"processor": processor(), "cores": os.cpu_count(), "load": load, "system": platform.platform()}


def versions() -> dict[str, str]:
    try:
        own = metadata.version("punctura")
    except metadata.PackageNotFoundError:
        own = "(not installed)"
    return {"punctura": own, "Python": platform.python_version(), "NumPy": np.__version__}


def time_loops(depth: Array, force: Array, ticks: int, repetitions: int) -> dict[str, dict[str, float]]:
    """ns per tick of the Python loops, measured in turn. First each must give the paper solver's forces to 1e-10 N."""
    depth, force = depth[:ticks], force[:ticks]
    for name, loop in LOOPS.items():
        if not (worst := float(np.max(np.abs(loop(depth) - force)))) <= 1e-10:
            raise ProgramError(f"the {name} loop and the paper solver differ by {worst:.3g} N")
    times: dict[str, list[float]] = {name: [] for name in LOOPS}
    for _ in range(repetitions):
        for name, loop in LOOPS.items():
            start = time.thread_time_ns()
            loop(depth)
            times[name].append((time.thread_time_ns() - start) / ticks)
    return {
        name: dict(
            zip(
                ("lower_quartile_ns", "median_ns", "upper_quartile_ns"),
                map(float, np.quantile(t, (0.25, 0.5, 0.75))),
                strict=True,
            )
        )
        for name, t in times.items()
    }


def measure(program: Path, seconds: float) -> dict[str, Any]:
    with tempfile.TemporaryDirectory() as folder:
        dump = Path(folder) / "work.f64"
        result = call(program, seconds, dump)
        depth, force = np.fromfile(dump).reshape(2, -1)
    result["versions"] = versions()
    return {"machine": machine()} | result | {"loops": time_loops(depth, force, LOOP_TICKS, LOOP_REPETITIONS)}


def report(result: dict[str, Any], ratios: list[Ratio], json_file: Path | None, check: bool) -> int:
    """Prints and writes the results. Returns the exit status: 1 if `check` is set and a target is missed, else 0."""
    if "rows" in result:
        print("\n".join(table(result)), end="\n\n")
        print("\n".join(verdicts(ratios)))
    if batches := result.get("batch"):
        print("\n" + "\n".join(batch_table(batches)))
    if wakeups := result.get("wakeups"):
        print("\n" + "\n".join(wakeup_table(wakeups)), end="\n\n")
        of_wakeups = over_cyclictest(wakeups)
        print("\n".join(verdicts(of_wakeups, "99.9 % quantile of the wake-up latency, all slices")))
        ratios = ratios + of_wakeups
    if json_file is not None:
        in_json = [{key: None if value != value else value for key, value in r._asdict().items()} for r in ratios]
        whole = result | {"ratios": in_json}
        json_file.write_text(json.dumps(whole, indent=1) + "\n", encoding="utf-8")
    return 1 if check and not all(r.passes for r in ratios) else 0


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        prog="./bench",
        description="Measures ns per tick against hand-written and NumPy loops, wake-up latency against cyclictest.",
    )
    parser.add_argument("--check", action="store_true", help="exit with 1 if a target is missed")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all results and the machine's data")
    parser.add_argument("--seconds", type=float, default=0.5, help="seconds for each of 33 rows (default %(default)s)")
    parser.add_argument(
        "--batch-seconds",
        type=float,
        default=1,
        metavar="S",
        help="seconds for each of 14 rows of many trials; 0 skips them (default %(default)s)",
    )
    parser.add_argument(
        "--wakeup-seconds",
        type=float,
        default=20,
        metavar="S",
        help=f"seconds for servo loop and cyclictest in each of {len(CONDITIONS)} conditions; 0 skips them "
        "(default %(default)s)",
    )
    parser.add_argument("--only-batches", action="store_true", help="measure the rows of many trials alone")
    parser.add_argument("--pictures", type=Path, metavar="FOLDER", help="draw the rows of many trials as SVG files")
    options = parser.parse_args(arguments)
    try:
        if options.only_batches:
            result = {"machine": machine(), "versions": versions()}
        else:
            program = build(ROOT / "build/bench")
            print("Measuring ticks, one dot per row:", file=sys.stderr)
            result = measure(program, options.seconds)
        if options.batch_seconds > 0:
            print("Measuring many trials, one dot per row:", file=sys.stderr)
            result["batch"] = measure_batches(build(ROOT / "build/bench", "bench_batch"), options.batch_seconds)
        if options.wakeup_seconds > 0 and not options.only_batches:
            wakeups = build(ROOT / "build/bench", "bench_wakeups")
            print("Measuring wake-ups, one dot per condition:", file=sys.stderr)
            result["wakeups"] = measure_wakeups(wakeups, options.wakeup_seconds)
    except ProgramError as error:
        print(error, file=sys.stderr)
        return 3
    status = report(result, all_ratios(result) if "rows" in result else [], options.json, options.check)
    if options.pictures and "batch" in result:
        draw(result["batch"], options.pictures)
    return status


if __name__ == "__main__":
    sys.exit(main())

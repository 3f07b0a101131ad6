"""Counts the instructions of a tick with valgrind, and compares them with the stored counts.

python benchmarks/instructions.py [--check] [--write]

A time depends on the machine and on what else it does; a count depends on the compiler and its libraries. The counts
are stored for each version of a compiler and each processor architecture in instructions.json. `./test instructions`
fails if a count has grown; with a compiler that has no stored counts, it says so and compares nothing.
"""

import argparse
import json
import os
import platform
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from program import ROOT, ProgramError, build, tool

STORED = Path(__file__).with_name("instructions.json")
KINDS = (
    "1-D paper", "1-D exact", "3-D paper", "3-D exact", "3-D paper, two membranes", "3-D exact, two membranes",
    "3-D exact, tissue",
    "servo step paper", "servo step exact", "servo step exact, line fit",
)  # fmt: skip
FEW, MANY = 500, 4_500  # ticks: the difference is one whole stroke, without the start of the program
MOST_MORE = 0.02


def collected(program: Path, kind: str, ticks: int) -> tuple[float, str]:
    """The instructions of a run, and the compiler."""
    valgrind = tool("valgrind")
    if valgrind is None:
        raise ProgramError("valgrind is missing; install Debian's package valgrind")
    command = [valgrind, "--tool=callgrind", "--callgrind-out-file=/dev/null", str(program), kind, str(ticks)]
    done = subprocess.run(command, capture_output=True, text=True)
    found = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or found is None:
        raise ProgramError(f"{' '.join(command)}\n{done.stderr[-2000:]}")
    return float(found[1]), done.stdout.strip()


def count(program: Path) -> tuple[str, dict[str, float]]:
    """The compiler with the architecture, and the instructions of a tick of each kind."""
    runs = [(kind, ticks) for kind in KINDS for ticks in (FEW, MANY)]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = dict(zip(runs, pool.map(lambda run: collected(program, *run), runs), strict=True))
    counts = {kind: round((found[kind, MANY][0] - found[kind, FEW][0]) / (MANY - FEW), 1) for kind in KINDS}
    return f"{found[runs[0]][1]} {platform.machine()}", counts


def table(counts: dict[str, float], stored: dict[str, float]) -> tuple[list[str], bool]:
    """The lines, and whether no count is more than 2 % above the stored one."""
    lines, good = [], True
    for kind, now in counts.items():
        before = stored.get(kind)
        more = before is not None and now > before * (1 + MOST_MORE)
        good = good and not more
        beside = "no stored count" if before is None else f"{before:8.1f} stored, {now / before - 1:+.1%}"
        lines.append(f"  {kind:28} {now:8.1f}   {beside}{'   MORE' if more else ''}")
    return lines, good


def main() -> int:
    parser = argparse.ArgumentParser(description="Counts the instructions of a tick with valgrind.")
    parser.add_argument("--check", action="store_true", help="exit with 1 if a count has grown by more than 2 %%")
    parser.add_argument("--write", action="store_true", help="store the counts for this compiler")
    options = parser.parse_args()
    try:
        compiler, counts = count(build(ROOT / "build/bench", "bench_instructions"))
    except ProgramError as error:
        print(error, file=sys.stderr)
        return 3
    known = json.loads(STORED.read_text()) if STORED.is_file() else {}
    lines, good = table(counts, known.get(compiler, {}))
    print("\n".join([f"Instructions of a tick, {compiler}, -O2", *lines]))
    if options.write:
        STORED.write_text(json.dumps(known | {compiler: counts}, indent=1) + "\n")
    elif compiler not in known:
        print(f"note: no counts are stored for {compiler}, so nothing is compared. --write stores these.")
    elif not good:
        print(f"A tick needs more than {MOST_MORE:.0%} more instructions than stored. Find out why. If it must be so:")
        print("  python benchmarks/instructions.py --write   # and commit benchmarks/instructions.json")
    return 1 if options.check and not good else 0


if __name__ == "__main__":
    sys.exit(main())

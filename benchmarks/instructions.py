"""Counts the instructions of a tick with valgrind, and compares them with those of an earlier version.

python benchmarks/instructions.py [--check] [--write]

A time depends on the machine and on what else it does; a count depends on the compiler only. The counts are stored
for each version of a compiler in instructions.json. This is no step of ./test, because another version of the
compiler, which an update of the system brings, gives other counts.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

from program import ROOT, ProgramError, build, tool

STORED = Path(__file__).with_name("instructions.json")
KINDS = (
    "1-D paper", "1-D exact", "3-D paper", "3-D exact", "3-D exact, tissue",
    "servo step paper", "servo step exact", "servo step exact, line fit",
)  # fmt: skip
FEW, MANY = 2_000, 10_000  # ticks: the difference has no start of the program in it
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
    """The compiler, and the instructions of a tick of each kind."""
    counts, compiler = {}, ""
    for kind in KINDS:
        few, compiler = collected(program, kind, FEW)
        many, _ = collected(program, kind, MANY)
        counts[kind] = round((many - few) / (MANY - FEW), 1)
    return compiler, counts


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
    return 1 if options.check and not good else 0


if __name__ == "__main__":
    sys.exit(main())

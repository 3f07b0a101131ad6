"""Compares the ticks of this tree with those of another commit: the same rows of ./bench, both programs in turn.

python benchmarks/paired.py COMMIT [--rounds N] [--seconds S] [--check]

Both programs are compiled now, with the same compiler and flags. A row is "slower" if the median of its ratios, one for
each round, is above 1.05. The ratios are of the fastest repetition of each program in a round.
"""

import argparse
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from program import ROOT, ProgramError, build, call

MOST = 1.05
Row = tuple[str, ...]


def export(commit: str, folder: Path) -> None:
    """The files of a commit. Raises ProgramError."""
    archive = subprocess.run(["git", "-C", str(ROOT), "archive", commit], capture_output=True)
    if archive.returncode != 0:
        raise ProgramError(archive.stderr.decode().strip())
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run(["tar", "-x", "-C", str(folder)], input=archive.stdout, check=True)


def fastest(result: dict[str, Any]) -> dict[Row, float]:
    """ns per tick of each row and solver."""
    times: dict[Row, float] = {}
    for row in result["rows"]:
        for name, timing in row["contestants"].items():
            key = (row["form"], row["scalar"], str(row["membranes"]), row["motion"], name)
            times[key] = timing.get("fastest_ns", timing["lower_quartile_ns"])
    return times


def compare(before: Path, after: Path, rounds: int, seconds: float) -> dict[Row, list[tuple[float, float]]]:
    """Times (before, after) in ns, one pair for each round, of the rows that both programs have."""
    pairs: dict[Row, list[tuple[float, float]]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for number in range(rounds):
            programs = [before, after] if number % 2 == 0 else [after, before]
            times = {program: fastest(call(program, seconds, Path(folder) / "work.f64")) for program in programs}
            for row in times[before].keys() & times[after].keys():
                pairs.setdefault(row, []).append((times[before][row], times[after][row]))
            print(".", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return pairs


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("commit", help="to compare with")
    parser.add_argument("--rounds", type=int, default=9, help="runs of each program (default %(default)s)")
    parser.add_argument("--seconds", type=float, default=0.05, help="for each row of a run (default %(default)s)")
    parser.add_argument("--check", action="store_true", help="exit with 1 if a row is slower")
    options = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory() as folder:
            tree = Path(folder) / "tree"
            export(options.commit, tree)
            before = build(Path(folder) / "build", source=tree)
            after = build(ROOT / "build/bench")
            pairs = compare(before, after, options.rounds, options.seconds)
    except ProgramError as error:
        print(error, file=sys.stderr)
        return 3
    slower = 0
    print(f"ns per tick, {options.commit} -> this tree, and the median ratio of {options.rounds} rounds")
    for row in sorted(pairs):
        ratio = statistics.median(after / before for before, after in pairs[row])
        was, now = (min(times) for times in zip(*pairs[row], strict=True))
        slower += ratio > MOST
        print(
            f"  {' '.join(f'{word:8}' for word in row)} {was:8.2f} -> {now:8.2f}  {ratio:5.2f}"
            f"{'  slower' if ratio > MOST else ''}"
        )
    print(f"{slower} of {len(pairs)} rows slower by more than {MOST - 1:.0%}")
    return 1 if options.check and slower else 0


if __name__ == "__main__":
    sys.exit(main())

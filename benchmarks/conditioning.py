"""Compares methods of position conditioning against encoder noise. See docs/conditioning.md.

python benchmarks/conditioning.py [--check] [--json FILE]
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from program import ROOT, ProgramError, build

# The demands on conditioning (docs/conditioning.md), and the method of the core that must meet them.
MOST_NOISE, MOST_POP_ERROR, MOST_ADDED_DELAY = 0.016, 0.02, 1e-3  # N rms, relative, s
CHOSEN = "line_fit"
SOLVERS = ("exact", "paper")
DITHERS = ("rest_toggle_N", "rest_two_N", "rest_three_N")

Method = dict[str, Any]


def noise(method: Method) -> float:
    """The largest force noise along one axis over all dithers and both solvers, N rms between ticks."""
    along = max(method[f"{solver}_{dither}"] for solver in SOLVERS for dither in DITHERS)
    across = max(method[f"{solver}_rest_across_N"] for solver in SOLVERS) / 2**0.5  # two axes
    return max(along, across, *(method[f"{solver}_rest_all_along_N"] for solver in SOLVERS))


def pop_error(method: Method) -> float:
    return max((method[f"{solver}_pop_error"] for solver in SOLVERS), key=abs)


class Verdict(NamedTuple):
    """The demands that a method meets."""

    noise: bool
    pop: bool
    delay: bool


def verdict(method: Method) -> Verdict:
    return Verdict(
        noise(method) <= MOST_NOISE,
        abs(pop_error(method)) <= MOST_POP_ERROR,
        method["added_delay_s"] < MOST_ADDED_DELAY,
    )


COLUMNS: tuple[tuple[str, Callable[[Method], str]], ...] = (
    ("toggle N", lambda m: f"{m['exact_rest_toggle_N']:.4f}"),
    ("three N", lambda m: f"{m['exact_rest_three_N']:.4f}"),
    ("xyz N", lambda m: f"{m['exact_rest_all_N']:.4f}"),
    ("pop %", lambda m: f"{100 * pop_error(m):+.2f}"),
    ("added ms", lambda m: f"{1e3 * m['added_delay_s']:+.2f}"),
    ("slow N", lambda m: f"{m['slow_worst_N']:.3f}"),
    ("loop", lambda m: f"{m['loop_counts']:.2f}"),
    ("stop", lambda m: f"{m['stop_200_counts']:.2f}"),
    ("creep N", lambda m: f"{m['creep_N']:.3f}"),
    ("shake mm/s", lambda m: f"{1e3 * m['exact_trembling_speed_m_per_s']:.2f}"),
    ("free mm/s", lambda m: f"{1e3 * m['exact_frictionless_speed_m_per_s']:.2f}"),
    ("K N/mm", lambda m: f"{m['largest_stiffness_N_per_m'] / 1e3:.2f}"),
    ("ns", lambda m: f"{m['cost_ns']:.0f}"),
    ("meets", lambda m: ", ".join(k for k, good in verdict(m)._asdict().items() if good) or "none"),
)


def table(result: dict[str, Any]) -> Iterator[str]:
    yield f"{result['compiler']}, {result['flags']}; one count is {1e3 * result['count_m']:g} mm"
    yield ""
    rows = [["", *(name for name, _ in COLUMNS)]]
    rows += [[m["name"], *(show(m) for _, show in COLUMNS)] for m in result["methods"]]
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    for row in rows:
        cells = [row[0].ljust(widths[0]), *(c.rjust(w) for c, w in zip(row[1:-1], widths[1:-1], strict=True)), row[-1]]
        yield "  ".join(cells).rstrip()
    yield ""
    for m in result["methods"]:
        yield f"{m['name'].ljust(widths[0])}  {m['note']}"


def measure(folder: Path) -> dict[str, Any]:
    program = build(folder, "bench_conditioning")
    print("Measuring, a dot for each method:", file=sys.stderr)
    done = subprocess.run([str(program)], stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise ProgramError(f"{program.name} ended with {done.returncode}; see its message above")
    result: dict[str, Any] = json.loads(done.stdout)
    return result


def report(result: dict[str, Any], json_file: Path | None, check: bool) -> int:
    """Prints and writes the results. Returns the exit status: 1 if `check` is set and CHOSEN misses a demand."""
    print("\n".join(table(result)))
    if json_file is not None:
        verdicts = {m["name"]: verdict(m)._asdict() for m in result["methods"]}
        json_file.write_text(json.dumps(result | {"meets": verdicts}, indent=1) + "\n", encoding="utf-8")
    chosen = next(m for m in result["methods"] if m["name"] == CHOSEN)
    return 1 if check and not all(verdict(chosen)) else 0


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description="Compares methods of position conditioning against encoder noise.")
    parser.add_argument("--check", action="store_true", help=f"exit with 1 if {CHOSEN} misses a demand")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all results")
    options = parser.parse_args(arguments)
    try:
        result = measure(ROOT / "build/bench")
    except ProgramError as error:
        print(error, file=sys.stderr)
        return 3
    return report(result, options.json, options.check)


if __name__ == "__main__":
    sys.exit(main())

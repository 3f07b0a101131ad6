"""Draws the rows of many trials at once.

python benchmarks/pictures.py RESULTS.json --out FOLDER     from the file of ./bench --json
"""

import argparse
import json
from pathlib import Path
from typing import Any

import matplotlib as mpl
from batch_rows import roofs
from matplotlib.axes import Axes
from matplotlib.figure import Figure

COLOURS = {"avx512": "#1f4e79", "avx2": "#2e8b8b", "sse2": "#c07f2a", "neon": "#1f4e79"}
FOLLOW = "#888888"


def faster(axes: Axes, batch: dict[str, Any]) -> None:
    """Bars: how many times faster than the core, for each row and instruction set."""
    rows = [(f"{r['solver']}, {r['trials']} trials", r["contestants"]) for r in batch["rows"]]
    rows += [(f"{r['solver']}, hand, {r['wall']}", r["contestants"]) for r in batch["hands"]]
    codes = [code for code in COLOURS if code in rows[0][1]]
    for k, code in enumerate(codes):
        at = [i + 0.27 * (k - (len(codes) - 1) / 2) for i in range(len(rows))]
        times = [contestants[code]["times_faster"] for _, contestants in rows]
        axes.barh(at, times, 0.25, color=COLOURS[code], label=code)
    axes.axvline(1, color="black", lw=0.8)
    axes.set_yticks(range(len(rows)), [name for name, _ in rows], fontsize=8)
    axes.invert_yaxis()
    axes.set_xlabel("times faster than the core, tick by tick")
    axes.legend(fontsize=8, frameon=False, loc="lower right")


def roofline(axes: Axes, batch: dict[str, Any]) -> None:
    """Reached operations against operations for each byte, under the roofs of memory and arithmetic."""
    peak = batch["peak"]
    intensity = {solver: counts["all"] / peak["line_bytes"] for solver, counts in peak["operations"].items()}
    across = (0.5, 1.0, *sorted(intensity.values()), 10.0)
    for code, most in peak["operations_per_ns"].items():
        roof = [min(most, peak["copied_bytes_per_ns"] * x) for x in across]
        axes.loglog(across, roof, color=COLOURS[code], lw=1, label=f"{code}, at most")
    axes.loglog(
        across, [peak["copied_bytes_per_ns"] * x for x in across], ":", color=FOLLOW, lw=1, label="copy in memory"
    )
    marks = dict(zip(sorted({r["trials"] for r in batch["rows"]}), "os^", strict=False))
    for trials, mark in marks.items():
        axes.loglog([], [], mark, color=FOLLOW, label=f"{trials} trials")
    for roof in roofs(batch):
        axes.loglog(intensity[roof.solver], roof.operations_per_ns, marks[roof.trials], color=COLOURS[roof.code])
    for solver, x in intensity.items():
        axes.text(x, 1.3 * max(peak["operations_per_ns"].values()), solver, ha="center", fontsize=8)
    axes.set(xlabel="operations for each byte", ylabel="operations each ns")
    axes.set_ylim(1.5, 2 * max(peak["operations_per_ns"].values()))
    axes.set_xticks(across, [f"{x:.2g}" for x in across])
    axes.set_yticks([2, 5, 10, 20, 50], ["2", "5", "10", "20", "50"])
    axes.minorticks_off()
    axes.legend(fontsize=7, frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))


def growth(axes: Axes, batch: dict[str, Any]) -> None:
    """The time of a trial and tick against the number of trials."""
    line = sorted((trials, ns) for trials, ticks, ns in batch["growth"]["line"] if ticks == 4000 or trials > 1024)
    axes.loglog([t for t, _ in line], [ns for _, ns in line], "o-", color=COLOURS["avx512"])
    axes.set(xlabel="trials", ylabel="ns for each trial and tick")
    axes.set_xticks([t for t, _ in line], [str(t) for t, _ in line])
    low, high = min(ns for _, ns in line), max(ns for _, ns in line)
    ticks = [t for t in (0.5, 1, 2, 4, 8, 16) if 0.7 * low <= t <= 1.5 * high]
    axes.set_yticks(ticks, [str(t) for t in ticks])
    axes.minorticks_off()
    axes.grid(axis="y", lw=0.4)


def draw(batch: dict[str, Any], out: Path) -> None:
    """batch: of measure_batches(). Writes three SVG files."""
    out.mkdir(parents=True, exist_ok=True)
    mpl.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "punctura", "font.size": 9, "axes.spines.top": False,
                         "axes.spines.right": False})  # fmt: skip
    for name, plot, height in (("faster", faster, 3.6), ("roofline", roofline, 3.2), ("growth", growth, 2.4)):
        figure = Figure(figsize=(6.8, height), layout="constrained")
        plot(figure.subplots(), batch)
        path = out / f"performance-{name}.svg"
        figure.savefig(path, metadata={"Date": None}, facecolor="white")
        text = " ".join(path.read_text(encoding="utf-8").split())  # matplotlib begins a line at each point of a curve
        path.write_text(text + "\n", encoding="utf-8")
        print(path)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path)
    parser.add_argument("--out", type=Path, default=Path("docs/images"))
    options = parser.parse_args()
    draw(json.loads(options.results.read_text(encoding="utf-8"))["batch"], options.out)


if __name__ == "__main__":
    main()

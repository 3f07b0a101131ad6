"""Draws the pictures of docs/validation.md.

    python tools/validation_pictures.py [--out docs/images]

The misfits and the coverage are numbers of that page, written here once more: they take hours to compute. The
synthetic trace is computed anew. No picture shows a sample of a measured trace.
"""

from __future__ import annotations

import argparse
import runpy
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from punctura.identify import identify

TRY_INTERVALS = Path(__file__).with_name("try_intervals.py")
MISFITS = (  # what, rms error in % of the greatest force, goal
    ("Data0: K06", 5.3, 1.5),
    ("Data0: chosen, one tissue", 4.8, 1.5),
    ("Data0: walls of their own", 4.1, 1.5),
    ("Data0: best rise between pops, any law", 4.0, 1.5),
    ("Data0: best function of depth, any law", 3.2, 1.5),
    ("Data1: K06", 4.2, 2.2),
    ("Data1: chosen", 2.0, 2.2),
    ("Data0 to the first pop: K06", 6.4, None),
    ("Data0 to the first pop: exponential", 2.1, None),
    ("Data0 to the first pop: curved grip", 1.6, None),
)
COVERAGE = (  # noise, % of all intervals, % of those of the surface
    ("drift 30 mN", 95.3, 93.2),
    ("correlation 0.9", 94.9, 93.3),
    ("drift 10 mN", 96.8, 97.3),
    ("correlation 0.5", 97.1, 98.0),
    ("0.2 mm a sample", 97.2, 98.3),
    ("white", 95.0, 94.4),
)
COLOURS = {"bad": "#b4442c", "good": "#2c6fb4", "pale": "#9a9a9a"}


def misfits(axes: Axes) -> None:
    """A bar for each fit, with its goal."""
    for row, (name, error, goal) in enumerate(reversed(MISFITS)):
        missed = goal is not None and error > goal
        axes.barh(row, error, 0.6, color=COLOURS["bad"] if missed else COLOURS["good"])
        axes.text(max(error, goal or 0) + 0.08, row, f"{error} %", va="center", fontsize=8)
        if goal is not None:
            axes.plot([goal, goal], [row - 0.4, row + 0.4], color="black", lw=1.5)
        axes.text(-0.1, row, name, ha="right", va="center", fontsize=8)
    axes.set(yticks=[], xlim=(0, 7.2), xlabel="rms error, % of the greatest force that was fitted (black line: goal)")


def coverage(axes: Axes) -> None:
    """A point for each kind of noise: how many intervals hold the truth."""
    axes.axvspan(93, 97, color="#e4ecf5")
    for row, (name, every, surface) in enumerate(reversed(COVERAGE)):
        axes.plot(surface, row, "o", mfc="white", color=COLOURS["bad"], label="surface" if row == 0 else None)
        axes.plot(every, row, "o", color=COLOURS["good"], label="all parameters" if row == 0 else None)
        axes.text(84.7, row, name, ha="right", va="center", fontsize=8)
    axes.set(yticks=[], xlim=(85, 100), ylim=(-0.5, len(COVERAGE) - 0.5))
    axes.set_xlabel("95 % intervals that hold the truth, % (shaded: goal)")
    axes.legend(fontsize=8, loc="lower left", frameon=False)


def synthetic(axes: Axes, below: Axes) -> None:
    """A synthetic trace with slow noise, its fit, and what is left."""
    tool = runpy.run_path(str(TRY_INTERVALS))
    trace, needle, _ = tool["random_trace"](5010, tool["Conditions"](drift=0.03))
    found = identify(trace, needle, membranes=1)
    assert trace.time is not None
    axes.plot(trace.time, trace.force, color=COLOURS["pale"], lw=0.8, label="synthetic trace")
    axes.plot(trace.time, trace.force + found.fit.residuals, color=COLOURS["good"], lw=1.2, label="fit")
    axes.set(ylabel="force, N", xticklabels=[])
    axes.legend(fontsize=8, frameon=False)
    below.plot(trace.time, -1e3 * found.fit.residuals, color=COLOURS["bad"], lw=0.6)
    below.axhline(0, color="black", lw=0.5)
    below.set(xlabel="time, s", ylabel="left, mN", ylim=np.array([-1, 1]) * 130)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("docs/images"))
    out = parser.parse_args().out
    mpl.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "punctura", "font.size": 9, "axes.spines.top": False,
                         "axes.spines.right": False})  # fmt: skip
    for name, draw, left in (("misfits", misfits, 0.4), ("coverage", coverage, 0.2)):
        figure = Figure(figsize=(6.8, 2.9 if name == "misfits" else 2.2))
        draw(
            figure.subplots(
                gridspec_kw={"left": left, "right": 0.98, "bottom": 0.17 if left > 0.3 else 0.25, "top": 0.98}
            )
        )
        save(figure, out / f"validation-{name}.svg")
    figure = Figure(figsize=(6.8, 3.2))
    grid = {"height_ratios": [2.2, 1], "left": 0.1, "right": 0.98, "bottom": 0.15, "top": 0.98, "hspace": 0.12}
    synthetic(*figure.subplots(2, 1, gridspec_kw=grid))
    save(figure, out / "validation-slow-noise.svg")


def save(figure: Figure, path: Path) -> None:
    figure.savefig(path, metadata={"Date": None}, facecolor="white")
    text = " ".join(path.read_text(encoding="utf-8").split())  # matplotlib begins a line at each point of a curve
    path.write_text(text + "\n", encoding="utf-8")
    print(path)


if __name__ == "__main__":
    main()

"""Draws the picture of docs/validation.md.

    python tools/validation_pictures.py [--out docs/images]

No picture shows a sample of a measured trace.
"""

import argparse
import runpy
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from punctura.identify import identify

TRY_INTERVALS = Path(__file__).with_name("try_intervals.py")
COLOURS = {"bad": "#b4442c", "good": "#2c6fb4", "pale": "#9a9a9a"}


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

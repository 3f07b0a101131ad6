"""The figure of a comparison: the trace with each model, and what each model leaves."""

import os
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from punctura.reproduce import palette
from punctura.reproduce.style import figure_style, new_figure
from punctura.rivals.comparison import TraceComparison

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a6d00", "#56b4e9", "#5f6670")
DASHES = ("-", "--", ":")  # after all colours the next style
SUFFIXES = (".png", ".svg", ".pdf")
MM = 1e3


def save_figure(comparison: TraceComparison, file: str | os.PathLike[str]) -> None:
    """Writes a PNG, SVG or PDF file. Raises ValueError for another suffix, OSError."""
    file = Path(file)
    if file.suffix.lower() not in SUFFIXES:
        raise ValueError(f"{file}: a plot must end in {' or '.join(SUFFIXES)}")
    with figure_style():
        undated = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}.get(file.suffix.lower())
        figure(comparison).savefig(file, metadata=undated)  # a second run writes an identical file


def figure(comparison: TraceComparison) -> Figure:
    """Force against depth, or against time where the needle draws back or rests; residuals below.

    Save it inside `punctura.reproduce.style.figure_style()`.
    """
    trace = comparison.trace
    on_time = trace.time is not None and any(stroke.kind != "in" for stroke in comparison.segments.strokes)
    x = trace.time if on_time and trace.time is not None else trace.depth * MM
    drawn = new_figure(4.6)
    upper, lower = drawn.subplots(2, 1, sharex=True, height_ratios=(2, 1))
    assert isinstance(upper, Axes) and isinstance(lower, Axes)
    upper.plot(x, trace.force, ".", ms=2.5, color=palette.MUTED.light, label="measured")
    for i, row in enumerate(comparison.rows):
        dashes = DASHES[i // len(COLOURS) % len(DASHES)]
        label = f"{row.title}, {100 * row.rmse_share:.1f} %"
        for axes, curve in ((upper, row.force), (lower, trace.force - row.force)):
            axes.plot(x, curve, label=label, lw=1.1, color=COLOURS[i % len(COLOURS)], ls=dashes)
    upper.set_ylabel("force against insertion (N)")
    lower.set_ylabel("measured less model (N)")
    lower.set_xlabel("time (s)" if on_time else "depth (mm)")
    upper.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), title="rms error, share of the peak")
    return drawn

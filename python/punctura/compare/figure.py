"""A figure of a comparison, for print."""

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from punctura.compare.comparison import Band, Comparison
from punctura.reproduce import palette
from punctura.reproduce.style import figure_style, new_figure

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a6d00", "#56b4e9", "#5f6670")
MOST_NAMED = 8  # runs in the legend; more are drawn in grey behind their mean
MM = 1e3


def figure(comparison: Comparison) -> Figure:
    """Model force, and against time also the depth: each run, and the mean with one standard deviation.

    Save it inside `punctura.reproduce.style.figure_style()`, which fixes fonts and line widths.
    """
    on_time = comparison.on == "time"
    drawn = new_figure(5.2 if on_time else 3.4)
    all_axes: Sequence[Axes] = drawn.subplots(2 if on_time else 1, 1, sharex=True, squeeze=False)[:, 0].tolist()
    names = [one.name for one in comparison.statistics]
    scale = 1.0 if on_time else MM
    _draw(all_axes[0], comparison.bands["model"], scale, 1.0, names)
    all_axes[0].set_ylabel("model force (N)")
    if on_time:
        _draw(all_axes[1], comparison.bands["depth"], scale, MM, names)
        all_axes[1].set_ylabel("depth of the tip (mm)")
        all_axes[1].invert_yaxis()
    all_axes[-1].set_xlabel("time since the first contact (s)" if on_time else "depth of the tip (mm)")
    all_axes[0].legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return drawn


def _draw(axes: Axes, band: Band, x_scale: float, y_scale: float, names: Sequence[str]) -> None:
    x = band.x * x_scale
    few = len(names) <= MOST_NAMED
    for i, (name, y) in enumerate(zip(names, band.runs, strict=True)):
        colour = COLOURS[i % len(COLOURS)] if few else palette.MUTED.light
        axes.plot(x, y * y_scale, lw=0.9, color=colour, alpha=1.0 if few else 0.35, label=name if few else None)
    if len(names) < 2:
        return
    mean, deviation = band.mean * y_scale, band.deviation * y_scale
    ink = palette.INK.light
    for k, at in enumerate(band.stretches):
        line, shade = (None, None) if k else (f"mean (n = {len(names)})", "standard deviation")
        axes.plot(x[at], mean[at], lw=1.6, color=ink, label=line)
        low, high = mean[at] - deviation[at], mean[at] + deviation[at]
        axes.fill_between(x[at], low, high, label=shade, color=ink, alpha=0.15, lw=0)


def save_figures(comparison: Comparison, folder: str) -> list[str]:
    """Writes figure.svg and figure.pdf into a folder; returns their names."""
    with figure_style():
        drawn = figure(comparison)
        for name in ("figure.svg", "figure.pdf"):
            drawn.savefig(f"{folder}/{name}")
    return ["figure.svg", "figure.pdf"]

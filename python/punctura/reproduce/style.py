"""The parts of a figure and their style: 300 dpi, matplotlib's own font, independent of the user's settings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib import font_manager, patheffects
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Annotation
from numpy.typing import NDArray

from punctura.reproduce import palette


@dataclass(frozen=True)
class Words:
    """The text of a figure."""

    title: str
    alt: str  # alternative text: the picture in one sentence
    text: tuple[str, ...]  # paragraphs: what to look for, and the relation to the paper


def read_words(name: str, **numbers: float) -> Words:
    """The text of a figure. `numbers` fill the named placeholders."""
    raw = files("punctura.reproduce").joinpath("words", f"{name}.txt").read_text(encoding="utf-8")
    title, alt, *text = (part.strip().format(**numbers) for part in raw.strip().split("\n\n"))
    return Words(title, alt, tuple(text))


WIDTH_IN = 7.0  # width of two journal columns
DPI = 300

_SETTINGS: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "mathtext.fontset": "dejavusans",
    "font.size": 8.5,
    "axes.titlesize": 9,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 9,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "axes.edgecolor": palette.MUTED.light,
    "axes.labelcolor": palette.INK.light,
    "text.color": palette.INK.light,
    "xtick.color": palette.MUTED.light,
    "ytick.color": palette.MUTED.light,
    "xtick.labelcolor": palette.INK.light,
    "ytick.labelcolor": palette.INK.light,
    "axes.linewidth": 0.7,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": palette.GRID.light,
    "grid.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "figure.facecolor": palette.PAGE.light,
    "axes.facecolor": "none",
    "savefig.facecolor": palette.PAGE.light,
    "lines.solid_capstyle": "round",
    "lines.solid_joinstyle": "round",
    "svg.fonttype": "path",  # text as paths, so that a missing font changes nothing
    "svg.hashsalt": "punctura",  # fixed ids, so that a second run writes an identical file
}


@contextmanager
def figure_style() -> Iterator[None]:
    """Within the block, uses matplotlib's defaults and the settings above. Ignores the user's matplotlibrc."""
    own_font = Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"
    font_manager.fontManager.addfont(own_font)
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        settings: Any = matplotlib.rcParams
        settings.update(_SETTINGS)
        yield


def new_figure(height_in: float, width_in: float = WIDTH_IN) -> Figure:
    """A figure without a window and without pyplot."""
    figure = Figure(figsize=(width_in, height_in), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def halo(width: float = 2.5) -> list[patheffects.AbstractPathEffect]:
    """An outline in the page's colour, so that text on a line stays readable."""
    return [patheffects.withStroke(linewidth=width, foreground=palette.PAGE.light)]


def note(
    axes: Axes,
    text: str,
    at: tuple[float, float],
    place: tuple[float, float],
    colour: palette.Colour = palette.INK,
    **more: Any,
) -> Annotation:
    """Text at `place` with a thin leader line to `at`, both in data units."""
    return axes.annotate(
        text,
        xy=at,
        xytext=place,
        color=colour.light,
        path_effects=halo(),
        arrowprops={"arrowstyle": "-", "color": palette.MUTED.light, "linewidth": 0.6, "shrinkA": 1, "shrinkB": 2},
        **{"ha": "center", "va": "center", "fontsize": 8, **more},
    )


def arrow(
    axes: Axes,
    start: tuple[float, float],
    end: tuple[float, float],
    colour: palette.Colour = palette.INK,
    size: float = 9,
) -> None:
    """A small filled arrow head at `end` that shows a direction."""
    axes.annotate(
        "",
        xy=end,
        xytext=start,
        arrowprops={
            "arrowstyle": "-|>",
            "color": colour.light,
            "linewidth": 0.9,
            "mutation_scale": size,
            "shrinkA": 0,
            "shrinkB": 0,
        },
    )


Table = Mapping[str, Sequence[Any] | NDArray[Any]]
"""Columns by name, with the unit in the name. All have the same length."""


@dataclass(frozen=True)
class Measured:
    """A number measured in a run, and the expected number from the law (NaN if the law gives none)."""

    figure: str  # of K06
    quantity: str  # in words
    unit: str  # of both numbers
    expected: float  # from the law
    measured: float  # in the run
    source: str  # source of the expected number


@dataclass(frozen=True)
class Drawing:
    """One figure. `tables` hold exactly the drawn data and are written as CSV files."""

    name: str  # name of its files, without suffix
    words: Words
    figure: Figure
    tables: Mapping[str, Table]  # file name without suffix -> columns
    measured: tuple[Measured, ...] = ()

"""Pictures of a study: how a result is distributed, and how it goes with each variable."""

from __future__ import annotations

import io
import re
from pathlib import Path

import numpy as np
import numpy.typing as npt

from punctura.files.whole_file import write_whole
from punctura.study.folder import Folder
from punctura.study.plan import Plan

Array = npt.NDArray[np.float64]
_MOST_PANELS = 8
_MOST_POINTS = 500  # more trials than this are drawn as quantiles
_BINS = 20


def draw(plan: Plan, folder: Folder, name: str, column: Array, values: dict[str, Array]) -> Path | None:
    """Writes pictures/NAME.svg. values: by variable, for each trial. Returns its path; None if no trial has a value."""
    from matplotlib.figure import Figure

    from punctura.reproduce.style import figure_style

    good = np.isfinite(column)
    if not good.any():
        return None
    shown = list(values)[: _MOST_PANELS - 1]
    across = min(4, 1 + len(shown))
    down = -(-(1 + len(shown)) // across)
    with figure_style():
        figure = Figure(figsize=(2.6 * across, 2.2 * down), layout="constrained")
        panels = [figure.add_subplot(down, across, i + 1) for i in range(1 + len(shown))]
        panels[0].hist(column[good], bins=min(40, max(5, int(np.sqrt(good.sum())))), color="0.45")
        panels[0].set_xlabel(name)
        panels[0].set_ylabel("trials")
        for panel, path in zip(panels[1:], shown, strict=True):
            at, of = values[path][good], column[good]
            if len(of) <= _MOST_POINTS:
                panel.plot(at, of, ".", ms=3, color="0.2")
            else:
                middle, low, half, high = _quantiles(at, of)
                panel.fill_between(middle, low, high, color="0.8", lw=0)
                panel.plot(middle, half, color="0.2", lw=1.2)
            panel.set_xlabel(path)
            panel.set_ylabel(name)
        data = io.BytesIO()
        figure.savefig(data, format="svg", metadata={"Date": None})
    target = folder.path / "pictures" / f"{re.sub(r'[^A-Za-z0-9]+', '_', name).strip('_')}.svg"
    target.parent.mkdir(exist_ok=True)
    write_whole(target, data.getvalue())
    return target


def _quantiles(at: Array, of: Array) -> tuple[Array, Array, Array, Array]:
    """The middle of each bin of `at`, with as many trials in each, and the 5 %, 50 % and 95 % quantiles of `of`."""
    edges = np.unique(np.quantile(at, np.linspace(0, 1, _BINS + 1)))
    bins = np.clip(np.searchsorted(edges, at, side="right") - 1, 0, max(len(edges) - 2, 0))
    order = np.argsort(bins, kind="stable")
    parts = np.split(order, np.flatnonzero(np.diff(bins[order])) + 1)
    middle = np.array([np.median(at[part]) for part in parts])
    low, half, high = np.array([np.quantile(of[part], [0.05, 0.5, 0.95]) for part in parts]).T
    return middle, low, half, high

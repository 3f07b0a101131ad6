"""The report of a study: a table of the results, pictures, and Sobol indices."""

from __future__ import annotations

import io
import re
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pyarrow.compute as pc
import pyarrow.parquet as pq

from punctura.files.whole_file import write_whole
from punctura.study.folder import Folder
from punctura.study.plan import Plan

Array = npt.NDArray[np.float64]
_RESAMPLES = 200  # of the bootstrap
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


def in_trials(count: int) -> str:
    return f"{count} trial{'' if count == 1 else 's'}"


def write_report(plan: Plan, folder: Folder) -> tuple[Path, int]:
    """Writes report.md. Returns its path and the number of trials that a fault ended."""
    names = [name for name in plan.results if name != "fault"]
    faults = int(pc.sum(pc.not_equal(pq.read_table(folder.table, columns=["fault"])["fault"], "none")).as_py() or 0)
    lines = [f"# Study {plan.path.name}", "", f"Scene {plan.scene.name}, method {plan.file.method}.", ""]
    lines += [
        "Values are in SI units; *without* counts the trials that have no value, such as a drop without a pop.",
        "",
    ]
    lines += ["| result | trials | without | mean | sd | 5 % | median | 95 % |", "|---|---|---|---|---|---|---|---|"]
    indices: list[str] = []
    pictures: list[str] = []
    variables = [one.path for one in plan.variables]
    table = pq.read_table(folder.table, columns=variables)
    values = {path: table[path].to_numpy() for path in variables}
    for name in names:
        column = pq.read_table(folder.table, columns=[name])[name].to_numpy().astype(np.float64)
        good = column[np.isfinite(column)]
        if len(good):
            numbers = [good.mean(), good.std(), *np.quantile(good, [0.05, 0.5, 0.95])]
            cells = " | ".join(f"{x:.4g}" for x in numbers)
        else:
            cells = " | ".join(["-"] * 5)
        if (picture := draw(plan, folder, name, column, values)) is not None:
            pictures.append(f"![{name}]({picture.relative_to(folder.path).as_posix()})")
        lines.append(f"| {name} | {len(column)} | {len(column) - len(good)} | {cells} |")
        if plan.file.method == "sobol":
            indices += _indices(plan, name, column)
    lines += ["", f"A fault ended {in_trials(faults)}."]
    if indices:
        head = "| result | variable | first order | 95 % | total | 95 % |"
        about = (
            f"The share of the variance that one variable explains alone (first order) and with others (total), with "
            f"bootstrap intervals of {_RESAMPLES} resamples. The randomness of the hand is one more source of variance."
        )
        lines += ["", "## Sobol indices", "", about, "", head, "|---|---|---|---|---|---|", *indices]
    about = (
        "The distribution of each result, and how it goes with each variable: a point for each trial or, with "
        "many trials, the median and the range from 5 to 95 %."
    )
    lines += ["", "## Pictures", "", about, "", *[line for picture in pictures for line in (picture, "")]]
    path = folder.path / "report.md"
    write_whole(path, ("\n".join(lines).rstrip() + "\n").encode())
    return path, faults


def _indices(plan: Plan, name: str, column: Array) -> list[str]:
    """The rows of one result. A result without a value in some trials, or without variance, has no indices."""
    from scipy.stats import sobol_indices

    n, count = plan.file.samples or 0, len(plan.variables)
    if not np.isfinite(column).all():
        return [f"| {name} | none: some trials have no value | | | | |"]
    if np.ptp(column[: 2 * n]) == 0:
        return [f"| {name} | none: the value is the same in all trials | | | | |"]
    parts = {
        "f_A": column[:n].reshape(1, n),
        "f_B": column[n : 2 * n].reshape(1, n),
        "f_AB": column[2 * n :].reshape(count, 1, n),
    }
    found = sobol_indices(func=parts, n=n, random_state=np.random.default_rng(plan.file.seed))
    around = found.bootstrap(confidence_level=0.95, n_resamples=_RESAMPLES)
    first, total = np.ravel(found.first_order), np.ravel(found.total_order)
    spans = [
        [np.ravel(one.confidence_interval.low), np.ravel(one.confidence_interval.high)]
        for one in (around.first_order, around.total_order)
    ]
    return [
        f"| {name} | {one.path} | {first[k]:.3f} | {spans[0][0][k]:.3f} to {spans[0][1][k]:.3f} "
        f"| {total[k]:.3f} | {spans[1][0][k]:.3f} to {spans[1][1][k]:.3f} |"
        for k, one in enumerate(plan.variables)
    ]

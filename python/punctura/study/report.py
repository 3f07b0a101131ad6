"""The report of a study: a table of the results, pictures, and Sobol indices."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt
import pyarrow.compute as pc
import pyarrow.parquet as pq

from punctura.files.whole_file import write_whole
from punctura.study.folder import Folder
from punctura.study.pictures import draw
from punctura.study.plan import Plan

Array = npt.NDArray[np.float64]
_RESAMPLES = 200


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

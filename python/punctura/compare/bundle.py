"""Everything about a comparison in one zip file, ready to cite, with its figure."""

import os
import shutil
import tempfile
import zipfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import punctura
from punctura.compare.comparison import NUMBERS, Band, Comparison, On, compare
from punctura.compare.run import Run
from punctura.compare.statistics import Statistics
from punctura.files.whole_file import whole_file
from punctura.record.header import build_id
from punctura.reproduce import palette
from punctura.reproduce.style import figure_style, new_figure
from punctura.scene import scene_text
from punctura.ticks.files import save

README = """{title}

Made by Punctura {version}.
Build: {build}

figure.svg, figure.pdf    the model force of each run, and the mean of {n} runs with one standard deviation (n - 1)
curves.csv, .parquet      the drawn curves: {axis};
                          model force, felt force and force limit in N; for each: one column for each run, the mean, the
                          deviation, and the number n of runs at each place; with a syringe also the thumb's
                          model force in N, the pressure in Pa and the depth of the plunger in m
statistics.csv            the numbers of each run, SI; drop and overshoot are the largest of the run's pops
runs/NN.csv, .parquet     every tick of a run: time (s), depth of the tip below the first surface (m), forces (N)
scenes/NN.toml            the scene of a run; `punctura run FILE` runs it

{runs}

Model force: what the model gives. Felt force: what the device gives, after all limits. Force limit: the most that the
limits allow. A simulated run has no device: its felt force and its force limit are empty. Forces are positive if they
push the needle out. Work: of the hand against the force along the needle, in the first insertion up to its deepest
place. Overshoot: how far the bevel ran on past a membrane in the 0.3 s after the pop. {against}

How to cite: CITATION.cff. Please cite the software with its version, and the paper whose model it computes.
"""
AGAINST = {
    "depth": "Against depth, a curve has the values at the moment when the tip first came to each depth.",
    "time": "Time begins at the first contact of each run.",
}
AXIS = {"depth": "against the depth of the tip, m", "time": "against the time since the first contact, s"}
_UNITS = {
    "duration": "s", "depth": "m", "overshoot": "m", "work": "J", "felt_work": "J", "pressure_peak": "Pa",
    "plunger_travel": "m",
}  # fmt: skip
_CURVES = {"depth": "m", "pressure": "Pa", "plunger": "m", "force_limit": "N"}  # their units; the others are forces


MOST_TICKS_IN_ALL = 5_000_000  # of all runs together: with three membranes up to 1.4 GB as CSV before it is packed
BYTES_A_NUMBER = 2 * (25 + 8)  # at most, of a number in CSV and in Parquet, as a temporary file and in the zip


def check_ticks(total: int) -> None:
    """Raises ValueError if so many ticks are too many for one zip file."""
    if total > MOST_TICKS_IN_ALL:
        raise ValueError(
            f"the runs have {total} ticks together; a zip file takes at most {MOST_TICKS_IN_ALL}: choose fewer or "
            "shorter runs"
        )


def _check_room(folder: Path, needed: int) -> None:
    free = shutil.disk_usage(folder).free
    if needed > free:
        raise ValueError(
            f"the next run needs up to {needed / 1e6:.0f} MB in {folder.absolute()}, where {free / 1e6:.0f} MB are "
            "free: make room, or choose fewer or shorter runs"
        )


def save_bundle(
    runs: Iterable[Run], path: str | os.PathLike[str], on: On = "depth", title: str = "A comparison of runs"
) -> Comparison:
    """Writes figure, curves, statistics, every tick, the scenes and how to cite them into a zip file.

    Raises ValueError for more than MOST_TICKS_IN_ALL, OSError. An existing file is replaced by a complete one only.
    """
    with (
        tempfile.TemporaryDirectory() as folder,
        whole_file(Path(path), private=True) as new,
        zipfile.ZipFile(new, "w", zipfile.ZIP_DEFLATED) as archive,
    ):
        place = Path(folder)

        def add(name: str, write: Callable[[Path], None]) -> None:
            file = place / name.replace("/", "-")
            write(file)
            archive.write(file, name)
            file.unlink()

        def kept() -> Iterator[Run]:
            total = 0
            for i, run in enumerate(runs, 1):
                total += len(run.time)
                check_ticks(total)
                table = ticks_table(run)
                for needed in (place, Path(path).parent):
                    _check_room(needed, table.num_rows * table.num_columns * BYTES_A_NUMBER)
                for ending in ("csv", "parquet"):
                    add(f"runs/{i:02d}.{ending}", lambda file, table=table: save(table, file))  # type: ignore[misc]
                archive.writestr(f"scenes/{i:02d}.toml", scene_text(run.scene))
                yield run

        comparison = compare(kept(), on)
        for name in save_figures(comparison, folder):
            archive.write(place / name, name)
        for ending in ("csv", "parquet"):
            add(f"curves.{ending}", lambda file: save(curves_table(comparison), file))
        add("statistics.csv", lambda file: save(statistics_table(comparison.statistics), file))
        archive.writestr("README.txt", _readme(comparison, title))
        archive.writestr("CITATION.cff", citation())
    return comparison


def citation() -> str:
    """The text of CITATION.cff."""
    return (Path(punctura.__file__).parent / "CITATION.cff").read_text(encoding="utf-8")


def ticks_table(run: Run) -> pa.Table:
    """Every tick of a run as a table, SI."""
    columns = {"time_s": run.time, "depth_m": run.depth}
    columns |= {"model_force_N": run.model, "felt_force_N": run.felt, "force_limit_N": run.force_limit}
    if np.isfinite(run.thumb).any():
        columns |= {"thumb_force_N": run.thumb, "pressure_Pa": run.pressure, "plunger_m": run.plunger}
    for i in range(run.depths.shape[1]):
        columns |= {f"depth_{i}_m": run.depths[:, i], f"force_{i}_N": run.forces[:, i]}
    return pa.table(columns)


def curves_table(comparison: Comparison) -> pa.Table:
    """The curves as a table, SI; the columns of a run have its number, from 1 on."""
    unit = "s" if comparison.on == "time" else "m"
    table: dict[str, object] = {}
    for name, band in comparison.bands.items():
        table.setdefault(f"{comparison.on}_{unit}", band.x)
        of = f"{name}_{_CURVES.get(name, 'force_N')}"
        table |= {f"{of}_{i:02d}": row for i, row in enumerate(band.runs, 1)}
        table |= {f"{of}_mean": band.mean, f"{of}_deviation": band.deviation, f"{name}_n": band.count}
    return pa.table(table)


def statistics_table(statistics: list[Statistics]) -> pa.Table:
    """The numbers of each run as a table, SI."""
    table: dict[str, object] = {"run": [one.name for one in statistics]}
    table |= {f"{name}_{_UNITS.get(name, 'N')}": [getattr(one, name) for one in statistics] for name in NUMBERS}
    return pa.table(table | {"pops": [len(one.pops) for one in statistics]})


def _readme(comparison: Comparison, title: str) -> str:
    return README.format(
        title=title,
        version=punctura.__version__,
        build=build_id(),
        n=len(comparison.statistics),
        axis=AXIS[comparison.on],
        against=AGAINST[comparison.on],
        runs="\n".join(f"Run {i:02d}: {one.name}" for i, one in enumerate(comparison.statistics, 1)),
    )


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

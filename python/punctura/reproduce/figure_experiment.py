"""K06 Figs. 10, 11 and 12: the simulated operator at the simulated device."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from punctura.reproduce import palette, stages
from punctura.reproduce.drawing import Measured, Table
from punctura.reproduce.force_position import STAGE_COLOURS, draw_operation, operation_table
from punctura.reproduce.measure import of_law, of_trace
from punctura.reproduce.operator import Floats, Operation, steady
from punctura.reproduce.style import new_figure


def draw_experiment(run: Operation) -> tuple[Figure, Axes, Table]:
    """The figure of a run, without annotations, and its data."""
    y, ideal = steady(run.scene, float(-run.p_y_mm.min()) * 1e-3)
    guide: tuple[Floats, Floats] = (y * 1e3, np.asarray(ideal.force[:, 1]))
    figure = new_figure(4.4)
    axes = figure.add_subplot()
    draw_operation(axes, run, guide)
    figure.legend(handles=_legend(), loc="outside lower center", ncols=5, handlelength=1.6, columnspacing=1.4)
    return figure, axes, operation_table(run, guide)


def _legend() -> list[Line2D]:
    entries = [(name, STAGE_COLOURS[name], 1.6) for name in (stages.INSERTION, stages.REVERSAL, stages.WITHDRAWAL)]
    entries += [("paper's form, where it differs", palette.PAPER_FORM, 1.6), ("steady, ideal sensor", palette.GUIDE, 5)]
    return [Line2D([], [], color=colour.light, lw=width, label=label) for label, colour, width in entries]


def measured(figure: str, run: Operation) -> tuple[Measured, ...]:
    """Peak, plateau, drop and withdrawal of each membrane, with the values of the law."""
    scene, rows = run.scene, list[Measured]()
    for i, placed in enumerate(scene.membranes):
        law = of_law(scene.needle, placed.membrane)
        seen = of_trace(run.trace, i, scene.needle, placed.membrane)
        of = f", {placed.name}" if len(scene.membranes) > 1 else ""
        rows += [
            Measured(figure, "peak" + of, "N", law.peak, seen.peak, "largest of (18)"),
            Measured(
                figure, "depth of the tip at the peak" + of, "mm", law.pop_depth * 1e3, seen.pop_depth * 1e3, "(18)"
            ),
            Measured(figure, "plateau" + of, "N", law.plateau, seen.plateau, "F U/H, (18)"),
            Measured(figure, "drop at the pop" + of, "N", law.drop, seen.drop, "peak - plateau"),
            Measured(figure, "withdrawal" + of, "N", law.withdrawal, seen.withdrawal, "F U/H, (19)"),
        ]
    return tuple(rows)

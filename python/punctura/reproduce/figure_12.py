"""K06 Fig. 12: two membranes."""

from __future__ import annotations

import numpy as np

from punctura.reproduce.drawing import Drawing
from punctura.reproduce.figure_experiment import draw_experiment, measured
from punctura.reproduce.operator import Operation
from punctura.reproduce.palette import INSERTION, WITHDRAWAL
from punctura.reproduce.style import arrow, note
from punctura.reproduce.words import read_words


def figure_12(run: Operation) -> Drawing:
    """H = 1.0 mm and 0.5 mm, 3 mm apart."""
    figure, axes, table = draw_experiment(run)
    arrow(axes, (-6.9, 0.96), (-8.1, 1.05), INSERTION)
    arrow(axes, (-1.2, 0.36), (-2.2, 0.5), INSERTION)
    arrow(axes, (-6.6, -0.58), (-5.4, -0.55), WITHDRAWAL)
    arrow(axes, (-2.6, -0.16), (-1.4, -0.13), WITHDRAWAL)
    note(axes, "first pop", (-5.65, 0.93), (-5.2, 1.14), fontweight="bold")
    note(axes, "second pop", (-9.6, 1.05), (-10.6, 1.12), fontweight="bold")
    note(axes, "contact, first", (0.0, 0.0), (0.6, 0.25))
    note(axes, "contact, second", (-4.0, 0.54), (-2.9, 0.8))
    note(axes, "both shafts: 2 F", (-11.0, 0.83), (-11.0, 0.96))
    pops = [-float(run.p_y_mm[np.argmin(run.trace.axial_force[:, i])]) for i in (0, 1)]
    words = read_words("fig12", pop_1_mm=pops[0], pop_2_mm=pops[1])
    return Drawing("fig12", words, figure, {"fig12": table}, measured("Fig. 12", run))

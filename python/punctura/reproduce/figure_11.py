"""K06 Fig. 11: a thick membrane."""

from __future__ import annotations

import numpy as np

from punctura.reproduce.drawing import Drawing
from punctura.reproduce.figure_experiment import draw_experiment, measured
from punctura.reproduce.operator import Operation, paper_on_same_motion
from punctura.reproduce.palette import INSERTION, WITHDRAWAL
from punctura.reproduce.style import arrow, note
from punctura.reproduce.words import read_words


def figure_11(run: Operation) -> Drawing:
    """H = 4.0 mm."""
    figure, axes, table = draw_experiment(run)
    arrow(axes, (-1.9, 0.21), (-2.8, 0.3), INSERTION)
    arrow(axes, (-4.9, -0.29), (-4.1, -0.19), WITHDRAWAL)
    note(axes, "contact", (0.0, 0.0), (0.75, 0.07))
    note(axes, "no step: the pop is a hump", (-7.7, 0.502), (-8.7, 0.555))
    note(axes, "shaft only", (-9.5, 0.42), (-9.6, 0.485))
    note(axes, "reversal,\nat any depth", (-5.66, 0.1), (-4.2, 0.1))
    largest = float(np.abs(paper_on_same_motion(run) - run.f_y_N).max())
    words = read_words("fig11", largest_mN=largest * 1e3)
    return Drawing("fig11", words, figure, {"fig11": table}, measured("Fig. 11", run))

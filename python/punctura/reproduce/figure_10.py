"""K06 Fig. 10: a thin membrane."""

from __future__ import annotations

from punctura.reproduce.drawing import Drawing
from punctura.reproduce.figure_experiment import draw_experiment, measured
from punctura.reproduce.operator import Operation
from punctura.reproduce.palette import INSERTION, WITHDRAWAL
from punctura.reproduce.style import arrow, note
from punctura.reproduce.words import read_words


def figure_10(run: Operation) -> Drawing:
    """H = 0.1 mm."""
    figure, axes, table = draw_experiment(run)
    arrow(axes, (-2.6, 0.53), (-3.6, 0.62), INSERTION)
    arrow(axes, (-7.6, 0.46), (-8.6, 0.46), INSERTION)
    arrow(axes, (-4.4, -0.36), (-3.4, -0.36), WITHDRAWAL)
    arrow(axes, (-1.9, -0.13), (-0.9, -0.09), WITHDRAWAL)
    note(axes, "contact", (0.0, 0.0), (0.75, 0.12))
    note(axes, "pop", (-5.62, 0.6), (-6.6, 0.64), fontweight="bold")
    note(axes, "shaft only", (-6.2, 0.41), (-5.2, 0.28))
    note(axes, "turned before the pop", (-2.75, 0.25), (-4.2, 0.08))
    note(axes, "tip slips back\ninto the membrane", (-2.82, -0.25), (-1.35, -0.3))
    return Drawing("fig10", read_words("fig10"), figure, {"fig10": table}, measured("Fig. 10", run))

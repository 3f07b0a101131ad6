"""Draws f_y over p_y as in K06 Figs. 10 to 12."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from punctura.reproduce import palette, stages
from punctura.reproduce.drawing import Table
from punctura.reproduce.operator import Floats, Operation, paper_on_same_motion
from punctura.reproduce.palette import Colour

APART_N = 1e-3  # draw both solvers where they differ by more than this
STAGE_COLOURS: dict[str, Colour] = {
    stages.OUTSIDE: palette.MUTED,
    stages.INSERTION: palette.INSERTION,
    stages.REVERSAL: palette.STICKING,
    stages.WITHDRAWAL: palette.WITHDRAWAL,
}
_WIDTHS = {stages.REVERSAL: 0.45}


def draw_by_stage(axes: Axes, x: Floats, y: Floats, stage: NDArray[np.str_], width: float = 0.8) -> None:
    """One line through all points, coloured by stage."""
    for name, colour in STAGE_COLOURS.items():
        # A segment has the stage of its end point. The last segment, out of the membrane, has that of its start.
        way = np.where(stage[1:] == stages.OUTSIDE, stage[:-1], stage[1:]) == name
        drawn = np.zeros(stage.shape, dtype=bool)
        drawn[1:] |= way
        drawn[:-1] |= way
        axes.plot(
            np.where(drawn, x, np.nan),
            np.where(drawn, y, np.nan),
            color=colour.light,
            lw=_WIDTHS.get(name, width),
            zorder=4,
        )


def paper_differs(operation: Operation) -> tuple[Floats, NDArray[np.bool_]]:
    """The force of the paper's form for the motion of an exact run (N), and the ticks at which the two differ."""
    force = paper_on_same_motion(operation)
    return force, np.abs(force - operation.f_y_N) > APART_N


def draw_operation(axes: Axes, exact: Operation, steady: tuple[Floats, Floats]) -> None:
    """Draws the experiment, the paper's form below it where the two differ, and a steady ideal pass behind both."""
    axes.plot(*steady, color=palette.GUIDE.light, lw=5, zorder=1)
    force, apart = paper_differs(exact)
    apart = _widen(apart)
    axes.plot(
        np.where(apart, exact.p_y_mm, np.nan),
        np.where(apart, force, np.nan),
        color=palette.PAPER_FORM.light,
        lw=1.1,
        zorder=3,
    )
    draw_by_stage(axes, exact.p_y_mm, exact.f_y_N, stages.stages(exact.trace.phase))
    axes.axhline(0, color=palette.MUTED.light, lw=0.6, zorder=0.5)
    axes.set_xlabel("$p_y$  (mm)   deeper to the left")
    axes.set_ylabel("$f_y$  (N)")


def operation_table(exact: Operation, steady: tuple[Floats, Floats]) -> Table:
    """The ticks of the run, followed by those of the steady pass."""
    force, apart = paper_differs(exact)
    rest = np.full(steady[0].size, np.nan)
    return {
        "line": np.repeat(["experiment", "steady"], [exact.p_y_mm.size, rest.size]),
        "time_s": np.concatenate([exact.trace.time, rest]),
        "p_y_mm": np.concatenate([exact.p_y_mm, steady[0]]),
        "f_y_exact_N": np.concatenate([exact.f_y_N, steady[1]]),
        "f_y_paper_N": np.concatenate([np.where(_widen(apart), force, np.nan), rest]),
        "stage": np.concatenate([stages.stages(exact.trace.phase), np.full(rest.size, "", dtype="<U10")]),
    }


def _widen(marked: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Extends the marks by one tick on either side, so that the second line starts on the first."""
    wide = marked.copy()
    wide[1:] |= marked[:-1]
    wide[:-1] |= marked[1:]
    return wide

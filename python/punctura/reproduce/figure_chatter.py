"""The close-up: the force at entry chatters with the paper's substitution (31), and not with the exact solution."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypedDict

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from punctura import Phase, ThickLaw
from punctura.reproduce import palette
from punctura.reproduce.experiment import (
    COUPLING,
    NEEDLE,
    Floats,
    Operation,
    Solver,
    alternations,
    k06_membrane,
    of_law,
    one_membrane,
    paper_on_same_motion,
    steady,
)
from punctura.reproduce.style import Drawing, Measured, Table, new_figure, note, read_words

SPEED = 5e-3  # m/s
THIN = 0.1e-3  # m, the membrane of Fig. 10
SWEEP_MM = tuple(round(float(h), 4) for h in np.geomspace(0.02, 4.0, 47))
SOLVERS: tuple[Solver, Solver] = ("exact", "paper")


@dataclass(frozen=True)
class SteadyEntry:
    """An insertion at constant speed with an ideal sensor, through filter and model."""

    time: Floats  # s, from the tick of first contact
    p_y: Floats  # m
    force: Floats  # f_y, N
    ticks_in_entry: int  # ticks until the point of the tip reaches the far face: q = H
    pop: tuple[float, float]  # N, before and after

    @property
    def turns(self) -> int:
        """Number of alternations from contact to the end of the insertion."""
        return alternations(self.force)


def steady_entry(thickness: float, solver: Solver, speed: float = SPEED) -> SteadyEntry:
    """Simulates the insertion, well past the pop."""
    law = ThickLaw(NEEDLE, k06_membrane(thickness))
    deepest = law.X + law.U + 3e-3
    scene = one_membrane(thickness, solver)
    y, trace = steady(scene, deepest, speed)
    inside = (trace.phase[:, 0] != int(Phase.outside)) & (np.arange(y.size) < y.size // 2)
    contact = int(np.argmax(inside))
    way_in = slice(contact, y.size // 2)
    depth, force = trace.depth[way_in, 0], trace.force[way_in, 1]
    largest_drop = int(np.argmin(np.diff(force)))
    return SteadyEntry(
        np.arange(force.size) / scene.servo.rate,
        y[way_in],
        force,
        int(np.argmax(depth > law.U)),
        (float(force[largest_drop]), float(force[largest_drop + 1])),
    )


def period() -> float:
    """T of the scenes, s."""
    return 1 / one_membrane(THIN).servo.rate


def swing(paper: SteadyEntry, exact: SteadyEntry) -> float:
    """Median tick-to-tick change of the difference between paper's and exact force during entry, N."""
    ticks = slice(0, exact.ticks_in_entry)
    return float(np.median(np.abs(np.diff(paper.force[ticks] - exact.force[ticks]))))


def onset() -> float:
    """The thickness (m) below which the substitution (31) does not converge at contact.

    An alternating error of f is multiplied per tick by |dPhi_I/dq| / g through (31), and by (1 + 2a) / (1 + a) through
    the offset (25), with a = B/D. At contact |dPhi_I/dq| = A_I Q / H. The total factor is 1 at this H.
    """
    law = ThickLaw(NEEDLE, k06_membrane(THIN))
    d = COUPLING.stiffness * period() + COUPLING.damping
    g, a = d / period(), COUPLING.damping / d
    return float(law.A_I * law.Q / g * (1 + 2 * a) / (1 + a))


class LineStyle(TypedDict):
    """How a solver's curves are drawn, in matplotlib's words."""

    color: str
    lw: float
    zorder: int


LINE: dict[Solver, LineStyle] = {
    "exact": {"color": palette.INSERTION.light, "lw": 1.4, "zorder": 4},
    "paper": {"color": palette.PAPER_FORM.light, "lw": 1.4, "zorder": 3},
}
CLOSE_UP = slice(150, 166)  # ticks, counted from contact
AFTER_ENTRY = 60  # ticks of panel a after the membrane is filled
WINDOW_S = 0.15  # of the experiment, panel d
FAST = 20e-3  # m/s, for comparison


def _thin(solver: Solver) -> LineStyle:
    return {**LINE[solver], "lw": 0.8}


def figure_chatter(fig_10: Operation) -> Drawing:
    """Four panels: difference, close-up, thickness, experiment."""
    exact, paper = (steady_entry(THIN, solver) for solver in SOLVERS)
    counts = {solver: [steady_entry(h * 1e-3, solver).turns for h in SWEEP_MM] for solver in SOLVERS}
    figure = new_figure(5.8)
    (difference, close), (sweep, experiment) = figure.subplots(2, 2)
    shown = slice(0, exact.ticks_in_entry + AFTER_ENTRY)
    _difference(difference, exact, paper, shown)
    _close(close, exact, paper)
    _sweep(sweep, counts)
    window = _experiment(experiment, fig_10)
    handles = [Line2D([], [], **LINE["exact"], label="exact")]
    handles += [Line2D([], [], **LINE["paper"], label="paper's form (33)")]
    figure.legend(handles=handles, loc="outside lower center", ncols=2)
    words = read_words(
        "chatter",
        speed_mm_s=SPEED * 1e3,
        turns_paper=paper.turns,
        turns_exact=exact.turns,
        onset_mm=onset() * 1e3,
        swing_mN=swing(paper, exact) * 1e3,
        fast_mm_s=FAST * 1e3,
        fast_swing_mN=swing(*(steady_entry(THIN, solver, FAST) for solver in ("paper", "exact"))) * 1e3,
        experiment_exact=alternations(np.asarray(window["f_y_exact_N"])),
        experiment_paper=alternations(np.asarray(window["f_y_paper_N"])),
    )
    in_close_up = np.zeros(exact.force.size, dtype=int)
    in_close_up[CLOSE_UP] = 1
    tables: dict[str, Table] = {
        "chatter": {
            "time_ms": exact.time[shown] * 1e3,
            "p_y_mm": exact.p_y[shown] * 1e3,
            "f_y_exact_N": exact.force[shown],
            "f_y_paper_N": paper.force[shown],
            "in_close_up": in_close_up[shown],
        },
        "chatter-thickness": {"H_mm": SWEEP_MM, "turns_exact": counts["exact"], "turns_paper": counts["paper"]},
        "chatter-experiment": window,
    }
    return Drawing("chatter", words, figure, tables, _measured(exact, paper))


def _measured(exact: SteadyEntry, paper: SteadyEntry) -> tuple[Measured, ...]:
    law, at = of_law(NEEDLE, k06_membrane(THIN)), f"at {SPEED * 1e3:g} mm/s"
    return (
        Measured("Close-up", f"turns of the force {at}, exact", "", 1, exact.turns, "one, at the pop"),
        Measured("Close-up", f"turns of the force {at}, paper's form", "", np.nan, paper.turns, ""),
        Measured("Close-up", f"force before the pop {at}, exact", "N", law.peak, exact.pop[0], "largest of (18)"),
        Measured("Close-up", f"force after the pop {at}, exact", "N", law.plateau, exact.pop[1], "F U/H, (18)"),
    )


def _difference(axes: Axes, exact: SteadyEntry, paper: SteadyEntry, shown: slice) -> None:
    time = exact.time * 1e3
    axes.plot(time[shown], (paper.force - exact.force)[shown] * 1e3, color=palette.PAPER_FORM.light, lw=0.5)
    axes.plot(time[shown], np.zeros(time[shown].size), **LINE["exact"])
    axes.axvspan(time[CLOSE_UP.start], time[CLOSE_UP.stop], color=palette.GUIDE.light, lw=0, zorder=0.5)
    axes.set(title="a  steady 5 mm/s: paper's form minus exact", xlabel="time since contact  (ms)", ylabel="mN")


def _close(axes: Axes, exact: SteadyEntry, paper: SteadyEntry) -> None:
    for solver, run in zip(SOLVERS, (exact, paper), strict=True):
        axes.step(run.time[CLOSE_UP] * 1e3, run.force[CLOSE_UP], where="post", **LINE[solver])
    axes.set(title="b  the ticks marked in a", xlabel="time since contact  (ms)", ylabel="$f_y$  (N)")


def _sweep(axes: Axes, counts: dict[Solver, list[int]]) -> None:
    for solver in SOLVERS:
        axes.plot(SWEEP_MM, counts[solver], marker="o", ms=2.6, **_thin(solver))
    axes.axvline(onset() * 1e3, color=palette.MUTED.light, lw=0.8, ls=(0, (3, 2)))
    axes.set(xscale="log", title="c  turns of the force on the way in", xlabel="thickness $H$  (mm)", ylabel="count")
    axes.set_xticks([0.02, 0.1, 0.5, 1, 4], ["0.02", "0.1", "0.5", "1", "4"])
    axes.minorticks_off()
    note(axes, f"(31) settles\nabove {onset() * 1e3:.2f} mm", (onset() * 1e3, 160), (0.9, 190))


def _experiment(axes: Axes, run: Operation) -> Table:
    paper = paper_on_same_motion(run)
    start = int(np.argmax(run.f_y_N > 0)) - 8
    window = slice(start, start + round(WINDOW_S * run.scene.servo.rate))
    time = (run.trace.time[window] - run.trace.time[start]) * 1e3
    for solver, force in zip(SOLVERS, (run.f_y_N, paper), strict=True):
        axes.step(time, force[window], where="post", **_thin(solver))
    axes.set(title="d  at the simulated device", xlabel="time  (ms)", ylabel="$f_y$  (N)")
    return {
        "time_ms": time,
        "p_y_mm": run.p_y_mm[window],
        "f_y_exact_N": run.f_y_N[window],
        "f_y_paper_N": paper[window],
    }

"""K06 Figs. 3 and 5, the friction laws, and 10 to 12, the simulated operator at the simulated device."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from punctura import Membrane, Needle, ThickLaw, ThinLaw
from punctura.reproduce import palette
from punctura.reproduce.experiment import (
    NEEDLE,
    OUTSIDE,
    STAGE_COLOURS,
    Floats,
    Operation,
    draw_operation,
    k06_membrane,
    of_law,
    of_trace,
    operation_table,
    paper_on_same_motion,
    steady,
)
from punctura.reproduce.palette import INSERTION, WITHDRAWAL
from punctura.reproduce.style import Drawing, Measured, Table, arrow, new_figure, note, read_words

FRICTIONS = (0.01, 0.1, 0.2)
THICKNESSES_MM = (5.0, 3.0, 1.0, 0.5, 0.1)


def depths(deepest: float, breaks: list[float]) -> Floats:
    """Depths (m), starting just outside. Each break has a depth on either side, so that a step is drawn as a step."""
    edges = [x for b in (0.0, *breaks) for x in (math.nextafter(b, -math.inf), b, math.nextafter(b, math.inf))]
    return np.unique(np.concatenate([np.linspace(-1e-3, deepest, 1101), edges]))


def figure_3() -> Drawing:
    """The thin law for three coefficients of friction."""
    needle = Needle(diameter=1e-3, tip_angle=math.pi / 12)
    laws = [ThinLaw(needle, Membrane(600.0, 0.4, mu, 0.0)) for mu in FRICTIONS]
    q = depths(6e-3, [laws[0].X])
    table: dict[str, Floats] = {"q_mm": q * 1e3}
    figure = new_figure(3.9)
    axes = figure.add_subplot()
    for law, mu, colour in zip(laws, FRICTIONS, palette.FRICTIONS, strict=True):
        for edge, values, dashes in zip("IO", law.bounds(q), ("-", (0, (5, 1.6))), strict=True):
            table[f"phi_{edge}_N (mu={mu:g})"] = values
            axes.plot(q * 1e3, values, color=colour.light, lw=1.5, ls=dashes)
        axes.annotate(
            f"$\\mu$ = {mu:g}", (6.08, -law.F), color=colour.light, fontsize=9, va="center", annotation_clip=False
        )
    axes.axhline(0, color=palette.MUTED.light, lw=0.6, zorder=0.5)
    axes.axvline(laws[0].X * 1e3, color=palette.MUTED.light, lw=0.6, ls=(0, (2, 3)), zorder=0.5)
    axes.annotate("$X = w/\\tan\\theta$", (laws[0].X * 1e3, 0.42), (4, 0), textcoords="offset points", fontsize=8)
    note(axes, "$\\phi_I$: sliding in", (1.9, float(laws[1].bounds(1.9e-3)[0])), (0.9, -0.72))
    note(axes, "$\\phi_O$: sliding out", (1.2, float(laws[2].bounds(1.2e-3)[1])), (1.0, 0.25))
    note(axes, "pop", (laws[0].X * 1e3, -0.62), (4.5, -0.72), fontweight="bold")
    axes.set(xlim=(-1, 6), xlabel="$q$  (mm)", ylabel="force on the needle  (N)")
    return Drawing(
        "fig03",
        read_words("fig03"),
        figure,
        {"fig03": table},
        tuple(
            Measured(
                "Fig. 3", f"step of the lower edge at X, μ = {mu:g}", "N", law.A_I * (law.X + law.Q) - law.F,
                float(law.bounds(math.nextafter(law.X, 1.0))[0] - law.bounds(law.X)[0]), "A_I (X + Q) - F, (15)",
            )
            for law, mu in zip(laws, FRICTIONS, strict=True)
        ),
    )  # fmt: skip


def figure_5() -> Drawing:
    """The thick law for five thicknesses."""
    laws = [ThickLaw(NEEDLE, k06_membrane(h * 1e-3)) for h in THICKNESSES_MM]
    q = depths(10e-3, [b for law in laws for b in (law.X, law.U, law.X + law.U)])
    table: dict[str, Floats] = {"q_mm": q * 1e3}
    figure = new_figure(3.9)
    axes = figure.add_subplot()
    for law, h, colour in zip(laws, THICKNESSES_MM, reversed(palette.THICKNESSES), strict=True):
        lower, upper = law.bounds(q)
        table[f"Phi_I_N (H={h:g} mm)"], table[f"Phi_O_N (H={h:g} mm)"] = lower, upper
        axes.plot(q * 1e3, lower, color=colour.light, lw=1.5, label=f"$H$ = {h:g} mm")
        axes.plot(q * 1e3, upper, color=colour.light, lw=1.5, ls=(0, (5, 1.6)))
    axes.axhline(0, color=palette.MUTED.light, lw=0.6, zorder=0.5)
    note(axes, "$\\Phi_I$: sliding in", (2.2, float(laws[-1].bounds(2.2e-3)[0])), (0.75, -0.69))
    note(axes, "$\\Phi_O$: sliding out", (4.6, float(laws[2].bounds(4.6e-3)[1])), (2.6, 0.33))
    note(axes, "the thinner, the sharper the pop", (3.9, -0.66), (6.4, -0.7))
    arrow(axes, (8.6, -0.47), (9.5, -0.47))
    arrow(axes, (9.5, 0.47), (8.6, 0.47))
    axes.set(xlim=(-1, 10), ylim=(-0.8, 0.55), xlabel="$q$  (mm)", ylabel="force on the needle  (N)")
    axes.legend(loc="center left", bbox_to_anchor=(0.83, 0.58))
    return Drawing(
        "fig05",
        read_words("fig05"),
        figure,
        {"fig05": table},
        tuple(
            Measured(
                "Fig. 5",
                f"plateau, H = {h:g} mm",
                "N",
                law.F,
                of_law(NEEDLE, k06_membrane(h * 1e-3)).plateau,
                "F, (15)",
            )
            for law, h in zip(laws, THICKNESSES_MM, strict=True)
        ),
    )


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
    entries = [(name, colour, 1.6) for name, colour in STAGE_COLOURS.items() if name != OUTSIDE]
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

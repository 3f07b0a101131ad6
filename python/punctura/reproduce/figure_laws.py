"""K06 Figs. 3 and 5: the friction laws."""

from __future__ import annotations

import math

import numpy as np

from punctura import Membrane, Needle, ThickLaw, ThinLaw
from punctura.reproduce import palette
from punctura.reproduce.drawing import Drawing, Measured
from punctura.reproduce.measure import of_law
from punctura.reproduce.operator import Floats
from punctura.reproduce.scenes import NEEDLE, k06_membrane
from punctura.reproduce.style import arrow, new_figure, note
from punctura.reproduce.words import read_words

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

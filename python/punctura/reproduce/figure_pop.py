"""One insertion and withdrawal: force over depth with the band behind it. An overview of the model."""

import numpy as np
from matplotlib.axes import Axes

from punctura import Phase, ThickLaw, Ticks
from punctura._core import Experiment, Hand, Plant, Strokes
from punctura.reproduce import palette
from punctura.reproduce.experiment import NEEDLE, draw_by_stage, k06_membrane, one_membrane, stages
from punctura.reproduce.palette import INSERTION, WITHDRAWAL
from punctura.reproduce.style import Drawing, arrow, new_figure, note, read_words

THICKNESS = 0.2e-3  # m
STROKE = Strokes((0.0, 1e-3, 0.0), (0.0, -9.6e-3, 0.0), count=1, duration=2.0, rest=0.55, variation=0.0)


def figure_pop() -> Drawing:
    """The stroke uses the same servo step as Figs. 10 to 12. The depth is that of the proxy, the virtual needle."""
    experiment = Experiment(one_membrane(THICKNESS), STROKE, Plant(encoder_step=0.0), Hand(tremor_rms=0.0))
    trace = experiment.run(experiment.duration)
    depth, force = trace.depth[:, 0] * 1e3, trace.force[:, 1]
    stage = stages(trace.phase)
    law = ThickLaw(NEEDLE, k06_membrane(THICKNESS))
    q = np.linspace(-1e-3, 8e-3, 1801)
    lower, upper = law.bounds(q)

    figure = new_figure(3.7)
    axes = figure.add_subplot()
    axes.fill_between(q * 1e3, -upper, -lower, color=palette.BAND.light, lw=0, zorder=0.6)
    axes.axhline(0, color=palette.MUTED.light, lw=0.6, zorder=0.7)
    draw_by_stage(axes, depth, force, stage, 1.9)
    _label(axes, law, trace)
    axes.set(xlim=(-1, 8), ylim=(-0.52, 0.82), xlabel="depth of the needle  (mm)", ylabel="force on the hand  (N)")
    return Drawing(
        "pop",
        read_words("pop", thickness_mm=THICKNESS * 1e3),
        figure,
        {
            "pop": {"time_s": trace.time, "depth_mm": depth, "f_y_N": force, "stage": stage},
            "pop-band": {"depth_mm": q * 1e3, "push_N": -lower, "pull_N": -upper},
        },
    )


def _label(axes: Axes, law: ThickLaw, trace: Ticks) -> None:
    def push(depth_mm: float) -> tuple[float, float]:
        return depth_mm, -float(law.bounds(depth_mm * 1e-3)[0])

    def pull(depth_mm: float) -> tuple[float, float]:
        return depth_mm, -float(law.bounds(depth_mm * 1e-3)[1])

    deepest = float(trace.depth[trace.phase[:, 0] == int(Phase.sliding_in), 0].max()) * 1e3
    pop = (law.X + law.U / 2) * 1e3
    arrow(axes, push(2.0), push(2.2), INSERTION, 14)
    arrow(axes, push(5.6), push(5.8), INSERTION, 14)
    arrow(axes, (deepest, 0.0), (deepest, -0.03), palette.STICKING, 12)
    arrow(axes, pull(5.8), pull(5.6), WITHDRAWAL, 14)
    arrow(axes, pull(2.2), pull(2.0), WITHDRAWAL, 14)
    axes.text(
        1.1,
        push(1.1)[1] + 0.035,
        "growing resistance",
        color=INSERTION.light,
        fontsize=9,
        rotation=float(np.degrees(np.arctan2(push(3)[1] - push(1)[1], 2.0))),
        rotation_mode="anchor",
        transform_rotates_text=True,
    )
    note(axes, "contact", (0.0, 0.0), (-0.55, 0.18))
    note(axes, "pop", (pop, 0.6), (4.6, 0.68), INSERTION, fontweight="bold", fontsize=11)
    axes.text(5.7, 0.45, "shaft friction", color=INSERTION.light, ha="center", fontsize=9)
    axes.text(5.7, -0.48, "withdrawal", color=WITHDRAWAL.light, ha="center", fontsize=9)
    note(axes, "stick at the reversal:\nthe force turns,\nthe needle rests", (deepest, 0.12), (5.65, 0.17))
    axes.text(2.0, 0.17, "any force in the band\nholds the needle", color=palette.MUTED.light, ha="center", va="center")

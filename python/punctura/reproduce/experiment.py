"""The experiments of K06 Figs. 10 to 12: the simulated operator, and what is drawn and measured of a run.

Both solvers get the same hand, strokes and seed. The scenes come from the package's scene files, the only place with
K06's section 4 values.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from punctura import Insertion, Membrane, Needle, Phase, Scene, ThickLaw, Ticks, load_scene
from punctura._core import Experiment, Hand, Plant, Strokes
from punctura.reproduce import palette
from punctura.reproduce.palette import Colour
from punctura.reproduce.style import Table

Floats = NDArray[np.float64]
Solver = Literal["exact", "paper"]
SEED = 209  # with this seed three strokes pop through, and one turns before the pop
START_MM = 1.5  # distance from the first surface
STROKE_DEPTH_MM = {"k06-fig10": 9.0, "k06-fig11": 9.0, "k06-fig12": 11.0}  # desired; the hand yields
COUNT, DURATION_S, REST_S, VARIATION = 4, 1.4, 0.35, 0.25
GUIDE_SPEED = 2e-3  # m/s, speed of the steady motion in the background
OUTSIDE, INSERTION, REVERSAL, WITHDRAWAL = "outside", "insertion", "reversal", "withdrawal"
APART_N = 1e-3  # draw both solvers where they differ by more than this
STAGE_COLOURS: dict[str, Colour] = {
    OUTSIDE: palette.MUTED,
    INSERTION: palette.INSERTION,
    REVERSAL: palette.STICKING,
    WITHDRAWAL: palette.WITHDRAWAL,
}
_WIDTHS = {REVERSAL: 0.45}


def k06_scene(name: str, solver: Solver = "exact") -> Scene:
    """The scene of a figure: k06-fig10, k06-fig11 or k06-fig12."""
    scene = load_scene(name)
    return scene.replace(servo=scene.servo.replace(solver=solver))


_FIG_10 = load_scene("k06-fig10")
NEEDLE = _FIG_10.needle
COUPLING = _FIG_10.coupling
INWARD = _FIG_10.membranes[0].inward_normal  # y points up, the needle goes down (docs/errata.md, E1)


def k06_membrane(thickness: float) -> Membrane:
    """The membrane of K06 Fig. 5 and section 4 with the given thickness (m)."""
    return _FIG_10.membranes[0].membrane.replace(thickness=thickness)


def one_membrane(thickness: float, solver: Solver = "exact") -> Scene:
    """The scene of Fig. 10 with another membrane thickness (m)."""
    scene = k06_scene("k06-fig10", solver)
    placed = scene.membranes[0]
    return scene.replace(membranes=[placed.replace(membrane=k06_membrane(thickness))])


def stages(phase: NDArray[np.uint8]) -> NDArray[np.str_]:
    """The stage of each tick, from phases (n ticks, m membranes). The needle slides if it slides in all membranes.

    Encoder positions are quantized, so a sliding proxy sticks between two counts. A sticking interval belongs to the
    slide around it if both sides slide in the same direction; otherwise it is a reversal.
    """
    out_of = phase == int(Phase.outside)
    slides_in = ((phase == int(Phase.sliding_in)) | out_of).all(axis=1)
    slides_out = ((phase == int(Phase.sliding_out)) | out_of).all(axis=1)
    outside = out_of.all(axis=1)
    marks = np.where(outside, 2, slides_in * 1 - slides_out * 1)
    before, after = _last_mark(marks), _last_mark(marks[::-1])[::-1]
    # A sticking tick between outside and a slide belongs to the slide.
    before = np.where(before == 2, after, before)
    after = np.where(after == 2, before, after)
    result = np.full(marks.shape, REVERSAL, dtype="<U10")
    result[(before == 1) & (after == 1)] = INSERTION
    result[(before == -1) & (after == -1)] = WITHDRAWAL
    result[outside] = OUTSIDE
    return result


def _last_mark(marks: NDArray[np.int64]) -> NDArray[np.int64]:
    """For each index the last nonzero mark up to and including it; 0 before the first."""
    places = np.maximum.accumulate(np.where(marks != 0, np.arange(marks.size), 0))
    return np.asarray(marks[places])


@dataclass(frozen=True)
class Operation:
    """A finished experiment: its inputs and its ticks."""

    scene: Scene
    strokes: Strokes
    trace: Ticks
    duration: float  # s

    @property
    def p_y_mm(self) -> Floats:
        """The measured position, as plotted in K06."""
        return np.asarray(self.trace.position[:, 1] * 1e3)

    @property
    def f_y_N(self) -> Floats:
        """The force sent to the actuators, after the limits."""
        return np.asarray(self.trace.force[:, 1])


def operate(scene: Scene, depth_mm: float) -> Operation:
    """Strokes to about `depth_mm`, run through the servo step of a real device: gate, filter, model, limits."""
    strokes = Strokes(
        start=(0.0, START_MM * 1e-3, 0.0),
        end=(0.0, -depth_mm * 1e-3, 0.0),
        count=COUNT,
        duration=DURATION_S,
        rest=REST_S,
        variation=VARIATION,
    )
    experiment = Experiment(scene, strokes, plant=Plant(), hand=Hand(), seed=SEED)
    trace = experiment.run(experiment.duration)
    if trace.fault_text:
        raise RuntimeError(f"the simulated run of {scene.name} stopped: {trace.fault_text}")
    return Operation(scene, strokes, trace, experiment.duration)


def steady(scene: Scene, deepest: float, speed: float = GUIDE_SPEED) -> tuple[Floats, Ticks]:
    """A pass to `deepest` (m) and back at constant speed with an ideal sensor. Returns y (m) and the model's ticks."""
    step = speed / scene.servo.rate
    way_in = np.arange(1e-3, -deepest, -step)
    y = np.concatenate([way_in, way_in[::-1]])
    position = np.zeros((y.size, 3))
    position[:, 1] = y
    return y, Insertion(scene).run(position, INWARD)


def paper_on_same_motion(operation: Operation) -> Floats:
    """f_y (N) of the paper's form for the measured positions of a run, tick by tick."""
    scene = operation.scene
    servo = scene.servo.replace(solver="paper")
    other = Scene(scene.name, scene.needle, scene.coupling, scene.membranes, servo, scene.direction)
    return np.asarray(Insertion(other).run(operation.trace.position, INWARD).force[:, 1])


def draw_by_stage(axes: Axes, x: Floats, y: Floats, stage: NDArray[np.str_], width: float = 0.8) -> None:
    """One line through all points, coloured by stage."""
    for name, colour in STAGE_COLOURS.items():
        # A segment has the stage of its end point. The last segment, out of the membrane, has that of its start.
        way = np.where(stage[1:] == OUTSIDE, stage[:-1], stage[1:]) == name
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
    draw_by_stage(axes, exact.p_y_mm, exact.f_y_N, stages(exact.trace.phase))
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
        "stage": np.concatenate([stages(exact.trace.phase), np.full(rest.size, "", dtype="<U10")]),
    }


def _widen(marked: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Extends the marks by one tick on either side, so that the second line starts on the first."""
    wide = marked.copy()
    wide[1:] |= marked[:-1]
    wide[:-1] |= marked[1:]
    return wide


@dataclass(frozen=True)
class Landmarks:
    """Characteristic numbers of a pass through one membrane. Resistance is positive against insertion."""

    peak: float  # N
    pop_depth: float  # m, depth of the tip in the membrane at the peak
    plateau: float  # N, with the shaft through the membrane
    withdrawal: float  # N, largest resistance against withdrawal

    @property
    def drop(self) -> float:
        """Decrease of the resistance at the pop, N."""
        return self.peak - self.plateau


def of_law(needle: Needle, membrane: Membrane) -> Landmarks:
    """The landmarks of K06 (18), (19) for a perpendicular needle."""
    law = ThickLaw(needle, membrane)
    depth = np.linspace(0.0, law.X + law.U, 200_001)
    lower, _ = law.bounds(depth)
    through_lower, through_upper = law.bounds(2 * (law.X + law.U))
    at = int(np.argmin(lower))
    return Landmarks(float(-lower[at]), float(depth[at]), float(-through_lower), float(through_upper))


def of_trace(trace: Ticks, membrane: int, needle: Needle, properties: Membrane) -> Landmarks:
    """The landmarks of a run for one membrane. The plateau is the median over ticks that slide in on the shaft."""
    law = ThickLaw(needle, properties)
    resistance: Floats = -trace.axial_force[:, membrane]
    depth: Floats = trace.depth[:, membrane]
    on_shaft = (depth > law.X + law.U) & (trace.phase[:, membrane] == int(Phase.sliding_in))
    at = int(np.argmax(resistance))
    return Landmarks(
        float(resistance[at]), float(depth[at]), float(np.median(resistance[on_shaft])), float(-np.min(resistance))
    )


def alternations(force: Floats, smallest: float = 1e-6) -> int:
    """Number of ticks at which the force step (N) changes its sign. Both steps must be larger than `smallest`."""
    step = np.diff(force)
    turned = (step[1:] * step[:-1] < 0) & (np.minimum(np.abs(step[1:]), np.abs(step[:-1])) > smallest)
    return int(np.count_nonzero(turned))

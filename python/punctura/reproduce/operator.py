"""The simulated operator of Figs. 10 to 12. Both solvers get the same hand, strokes and seed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from punctura import Insertion, Scene, Ticks
from punctura._core import Experiment, Hand, Plant, Strokes
from punctura.reproduce.scenes import INWARD

SEED = 209  # with this seed three strokes pop through, and one turns before the pop
START_MM = 1.5  # distance from the first surface
STROKE_DEPTH_MM = {"k06-fig10": 9.0, "k06-fig11": 9.0, "k06-fig12": 11.0}  # desired; the hand yields
COUNT, DURATION_S, REST_S, VARIATION = 4, 1.4, 0.35, 0.25
GUIDE_SPEED = 2e-3  # m/s, speed of the steady motion in the background

Floats = NDArray[np.float64]


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

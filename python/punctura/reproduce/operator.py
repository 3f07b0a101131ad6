"""The simulated operator of Figs. 10 to 12: the same hand, strokes and seed for both solvers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from punctura import Experiment, Hand, Insertion, Plant, Scene, Strokes, Ticks
from punctura.reproduce.scenes import INWARD

SEED = 209  # three strokes through the membrane, and one that turns before the pop
START_MM = 1.5  # above the first surface
STROKE_DEPTH_MM = {"k06-fig10": 9.0, "k06-fig11": 9.0, "k06-fig12": 11.0}  # wanted; the hand yields
COUNT, DURATION_S, REST_S, VARIATION = 4, 1.4, 0.35, 0.25
GUIDE_SPEED = 2e-3  # m/s, of the steady motion drawn behind

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Operation:
    """An experiment that is over: what went in and what came out."""

    scene: Scene
    strokes: Strokes
    trace: Ticks
    duration: float  # s

    @property
    def p_y_mm(self) -> Floats:
        """The measured position, as K06 plots it."""
        return np.asarray(self.trace.position[:, 1] * 1e3)

    @property
    def f_y_N(self) -> Floats:
        """What went to the actuators, limits included."""
        return np.asarray(self.trace.force[:, 1])


def operate(scene: Scene, depth_mm: float) -> Operation:
    """Strokes to about `depth_mm`, through the step that drives a real device: gate, filter, model, limits."""
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
    """In to `deepest` and out again (m) at a constant speed, with an ideal sensor: y (m) and what the model says."""
    step = speed / scene.servo.rate
    way_in = np.arange(1e-3, -deepest, -step)
    y = np.concatenate([way_in, way_in[::-1]])
    position = np.zeros((y.size, 3))
    position[:, 1] = y
    return y, Insertion(scene).run(position, INWARD)


def paper_on_same_motion(operation: Operation) -> Floats:
    """f_y (N) that the paper's form gives for the positions measured in a run, tick by tick."""
    scene = operation.scene
    servo = scene.servo.replace(solver="paper")
    other = Scene(scene.name, scene.needle, scene.coupling, scene.membranes, servo, scene.direction)
    return np.asarray(Insertion(other).run(operation.trace.position, INWARD).force[:, 1])

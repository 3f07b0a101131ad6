"""Runs without a device: the force along a given motion (docs/simulate.md), or with a simulated hand and device.

simulate() computes along a file or an array; an Experiment simulates the hand and the device (docs/plant.md).
"""

from punctura._core import Experiment, Hand, Plant, RecordedMotion, Strokes, Target
from punctura.simulation.columns import MotionError
from punctura.simulation.run import simulate
from punctura.simulation.summary import MembraneSummary, SimulationSummary

__all__ = [
    "Experiment",
    "Hand",
    "MembraneSummary",
    "MotionError",
    "Plant",
    "RecordedMotion",
    "SimulationSummary",
    "Strokes",
    "Target",
    "simulate",
]

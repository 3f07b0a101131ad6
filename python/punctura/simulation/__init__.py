"""Computes the model's force for a given motion, from file to file or in memory (docs/simulate.md)."""

from punctura.simulation.motion_error import MotionError
from punctura.simulation.run import simulate
from punctura.simulation.summary import MembraneSummary, SimulationSummary

__all__ = ["MembraneSummary", "MotionError", "SimulationSummary", "simulate"]

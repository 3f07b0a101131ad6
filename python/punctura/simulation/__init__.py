"""The model's force for a recorded motion, from file to file (docs/simulate.md)."""

from punctura.simulation.motion_error import MotionError
from punctura.simulation.run import simulate
from punctura.simulation.summary import MembraneSummary, SimulationSummary

__all__ = ["MembraneSummary", "MotionError", "SimulationSummary", "simulate"]

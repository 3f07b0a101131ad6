"""The ticks of a run as arrays: what a proxy, a simulation, a live loop and a recording all give."""

from punctura.ticks.columns import Columns
from punctura.ticks.fields import ABSENT, COMMAND_SCENE, FIELDS
from punctura.ticks.ticks import Ticks

__all__ = ["ABSENT", "COMMAND_SCENE", "FIELDS", "Columns", "Ticks"]

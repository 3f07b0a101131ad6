"""The ticks of a run as arrays, as returned by proxies, simulations, live loops and recordings."""

from punctura.ticks.fields import ABSENT, COMMAND_SCENE, FIELDS, INSIDE, Columns
from punctura.ticks.ticks import Ticks

__all__ = ["ABSENT", "COMMAND_SCENE", "FIELDS", "INSIDE", "Columns", "Ticks"]

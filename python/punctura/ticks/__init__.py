"""The ticks of a run as arrays, as returned by proxies, simulations, live loops and recordings."""

from punctura.ticks.columns import Columns
from punctura.ticks.fields import ABSENT, FIELDS
from punctura.ticks.ticks import Ticks

__all__ = ["ABSENT", "FIELDS", "Columns", "Ticks"]

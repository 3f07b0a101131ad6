"""The limits of the force in words, for the terminal, results and the page."""

from __future__ import annotations

# By the names of punctura._core.Limit, in the order of their codes.
LIMIT_WORDS = {
    "none": "",
    "ramp": "growing after it was turned on",
    "peak": "peak limit",
    "continuous": "long-run limit",
    "temperature": "warm motors",
}
CUTS = ("peak", "continuous", "temperature")  # they cut the force; a force that grows after arming is no news

# ruff: noqa: E402
"""Compares runs: statistics, mean curves, and the same motion with a parameter varied (docs/compare.md)."""

from punctura.extras import optional

optional("pyarrow", "files", "punctura.compare")  # before the imports below would fail

from punctura.compare.comparison import Band, Comparison, compare
from punctura.compare.motion import Motion, VaryError, recorded_motion, stroke, vary
from punctura.compare.run import Run, recorded_run
from punctura.compare.statistics import Pop, Statistics

__all__ = [
    "Band",
    "Comparison",
    "Motion",
    "Pop",
    "Run",
    "Statistics",
    "VaryError",
    "compare",
    "recorded_motion",
    "recorded_run",
    "stroke",
    "vary",
]

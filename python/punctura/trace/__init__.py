# ruff: noqa: E402
"""Measured traces of force against depth: reading, findings, segments (docs/identify.md)."""

from punctura.extras import optional

optional("pyarrow", "files", "punctura.trace")  # before the imports below would fail

from punctura.trace.read import read_trace
from punctura.trace.segment import Pop, Segments, Stroke, segment
from punctura.trace.trace import Finding, Trace, TraceError

__all__ = ["Finding", "Pop", "Segments", "Stroke", "Trace", "TraceError", "read_trace", "segment"]

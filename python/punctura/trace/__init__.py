"""Measured traces of force against depth: reading, findings, segments (docs/identify.md)."""

from punctura.trace.read import read_trace
from punctura.trace.segment import Pop, Segments, Stroke, segment
from punctura.trace.trace import Finding, MissingPackage, Trace, TraceError

__all__ = ["Finding", "MissingPackage", "Pop", "Segments", "Stroke", "Trace", "TraceError", "read_trace", "segment"]

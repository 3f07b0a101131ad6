"""Needle gauges as outer diameters."""

from __future__ import annotations

# ISO 9626:2016, Table 1: designated metric size (nominal outer diameter) of each gauge, mm.
GAUGE_DIAMETER_MM = {
    10: "3.4", 11: "3.0", 12: "2.7", 13: "2.4", 14: "2.1", 15: "1.8", 16: "1.6", 17: "1.4", 18: "1.2",
    19: "1.1", 20: "0.9", 21: "0.8", 22: "0.7", 23: "0.6", 24: "0.55", 25: "0.5", 26: "0.45", 27: "0.4",
    28: "0.36", 29: "0.33", 30: "0.3", 31: "0.25", 32: "0.23", 33: "0.2", 34: "0.18",
}  # fmt: skip

# ruff: noqa: E402
"""Membranes identified from measured traces of force against depth (docs/identify.md)."""

from punctura.extras import optional

optional("pyarrow", "identify", "punctura.identify")  # before the imports below would fail

from punctura.identify.identify import Identification, identify
from punctura.identify.intervals import Estimate
from punctura.identify.parameters import Parameters
from punctura.identify.rig import Rig

__all__ = ["Estimate", "Identification", "Parameters", "Rig", "identify"]

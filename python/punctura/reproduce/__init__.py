"""Reproduces K06's figures with the code that drives a device (docs/reproduce.md)."""

from punctura.reproduce.drawing import Measured
from punctura.reproduce.run import Reproduction, reproduce

__all__ = ["Measured", "Reproduction", "reproduce"]

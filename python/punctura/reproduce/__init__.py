"""K06's figures, from the code that drives the device (docs/reproduce.md)."""

from punctura.reproduce.drawing import Measured
from punctura.reproduce.run import Reproduction, reproduce

__all__ = ["Measured", "Reproduction", "reproduce"]

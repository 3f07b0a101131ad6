# ruff: noqa: E402
"""Reproduces K06's figures with the code that drives a device (docs/reproduce.md)."""

from punctura.extras import optional

optional("matplotlib", "plots", "punctura.reproduce")  # before the imports below would fail

from punctura.reproduce.run import Reproduction, reproduce
from punctura.reproduce.style import Measured

__all__ = ["Measured", "Reproduction", "reproduce"]

"""Punctura: the force of a needle that goes through tissue membranes and comes out again."""

from punctura._core import Membrane, Needle, ThickLaw, ThinLaw
from punctura.errors import ConfigurationError, Problem

__all__ = ["ConfigurationError", "Membrane", "Needle", "Problem", "ThickLaw", "ThinLaw"]

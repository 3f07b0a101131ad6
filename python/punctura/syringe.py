"""A syringe on the needle: its parts, its plunger, and what the tissue at the tip lets through (docs/syringe.md)."""

from punctura._core import Outlet, Plunger, Syringe, SyringeSettings, outlet_at, tube_resistance

__all__ = ["Outlet", "Plunger", "Syringe", "SyringeSettings", "outlet_at", "tube_resistance"]

"""Scenes as FMUs, for simulators with the Functional Mock-up Interface 2.0 or 3.0 (docs/fmi.md)."""

from punctura.fmu.export import export_fmu

__all__ = ["export_fmu"]

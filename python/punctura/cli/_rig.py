"""The option that says what is known of a rig."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

import typer

from punctura.cli._trace import pairs

if TYPE_CHECKING:
    from punctura.identify.rig import Rig

Option = Annotated[
    list[str] | None,
    typer.Option(
        "--rig",
        help="What is known of the sensors: depth_noise_um=10 (0: exact). Else the trace tells.",
        metavar="NAME=VALUE",
    ),
]
_UNITS = {"um": 1e-6, "ms": 1e-3}


def rig_of(given: list[str] | None) -> Rig:
    """The rig of `depth_noise_um=10`. Raises typer.BadParameter."""
    from dataclasses import fields

    from punctura.identify.rig import Rig

    known, values = {one.name for one in fields(Rig)}, {}
    for name, text in pairs(given, "--rig").items():
        kind, _, unit = name.rpartition("_")
        try:
            value = float(text) * _UNITS[unit]
        except (KeyError, ValueError):
            value = math.nan
        if kind not in known or not (0 <= value < math.inf):
            wanted = "must be as depth_noise_um=10, and not negative"
            raise typer.BadParameter(f"{name}={text} {wanted}", param_hint="--rig")
        values[kind] = value
    return Rig(**values)

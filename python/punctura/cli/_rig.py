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
_STATED = {"depth_noise_um": ("depth_noise", 1e-6)}
_EXAMPLE = "depth_noise_um=10"
_TOLERANCES = {
    "diameter_mm": ("diameter_tolerance", 1e-3), "tip_angle_rad": ("tip_angle_tolerance", 1.0),
    "tip_angle_deg": ("tip_angle_tolerance", math.radians(1.0)),
}  # fmt: skip


def rig_of(given: list[str] | None, needle: str) -> tuple[Rig, str]:
    """The rig of `depth_noise_um=10` and of a needle `diameter_mm=1.27+-0.03,tip_angle_deg=20`, and the needle without
    its tolerances. Raises typer.BadParameter.
    """
    from punctura.identify.rig import Rig

    values = {}
    for name, text in pairs(given, "--rig", _EXAMPLE).items():
        kind, factor = _STATED.get(name, ("", math.nan))
        values[kind] = factor * _number(text)
        if not 0 <= values[kind] < math.inf:
            wanted = f"must be as {_EXAMPLE}, and not negative"
            raise typer.BadParameter(f"{name}={text} {wanted}", param_hint="--rig")
    sizes = []
    for part in needle.replace("\u00b1", "+-").split(","):
        size, sign, tolerance = part.partition("+-")
        name, _, stated = size.partition("=")
        sizes.append(size)
        if sign:
            kind, factor = _TOLERANCES.get(name.strip(), ("", math.nan))
            values[kind] = factor * _number(tolerance)
            if not 0 <= values[kind] < 0.5 * factor * _number(stated):
                wanted = "must be as diameter_mm=1.27+-0.03, with a tolerance of less than half"
                raise typer.BadParameter(f"{part.strip()} {wanted}", param_hint="--needle")
    return Rig(**values), ",".join(sizes)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan

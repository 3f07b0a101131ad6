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
        help="What is known of the sensors: depth_noise_um=10, lag_ms=20+-2, delay_ms=20, play_um=50 (0: none). Else "
        "the trace tells.",
        metavar="NAME=VALUE",
    ),
]
_STATED = {
    "depth_noise_um": ("depth_noise", 1e-6), "lag_ms": ("lag", 1e-3), "delay_ms": ("delay", 1e-3),
    "play_um": ("play", 1e-6), "slack_um": ("slack", 1e-6),
}  # fmt: skip
_SIGN = "\u00b1", "+-"
_EXAMPLE = "depth_noise_um=10 or lag_ms=20+-2"
_TOLERANCES = {
    "diameter_mm": ("diameter_tolerance", 1e-3), "tip_angle_rad": ("tip_angle_tolerance", 1.0),
    "tip_angle_deg": ("tip_angle_tolerance", math.radians(1.0)), "lag_ms": ("lag_tolerance", 1e-3),
    "delay_ms": ("delay_tolerance", 1e-3), "play_um": ("play_tolerance", 1e-6),
    "slack_um": ("slack_tolerance", 1e-6),
}  # fmt: skip


def rig_of(given: list[str] | None, needle: str) -> tuple[Rig, str]:
    """The rig of `depth_noise_um=10` and of a needle `diameter_mm=1.27+-0.03,tip_angle_deg=20`, and the needle without
    its tolerances. Raises typer.BadParameter; rig.check() has the bounds.
    """
    from punctura.identify.rig import Rig

    values: dict[str, float] = {}
    for name, text in pairs(given, "--rig", _EXAMPLE).items():
        value, sign, tolerance = text.replace(*_SIGN).partition("+-")
        wanted = f"{name}={text} must be as {_EXAMPLE}"
        values |= _value(_STATED, name, value, wanted, "--rig")
        values |= _value(_TOLERANCES, name, tolerance, wanted, "--rig") if sign else {}
    sizes = []
    for part in needle.replace(*_SIGN).split(","):
        size, sign, tolerance = part.partition("+-")
        sizes.append(size)
        if sign:
            name = size.partition("=")[0].strip()
            wanted = f"{part.strip()} must be as diameter_mm=1.27+-0.03"
            values |= _value(_TOLERANCES, name, tolerance, wanted, "--needle")
    return Rig(**values), ",".join(sizes)


def _value(kinds: dict[str, tuple[str, float]], name: str, text: str, wanted: str, option: str) -> dict[str, float]:
    try:
        kind, factor = kinds[name]
        return {kind: factor * float(text)}
    except (KeyError, ValueError):
        raise typer.BadParameter(wanted, param_hint=option) from None

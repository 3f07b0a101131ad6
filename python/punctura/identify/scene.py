"""The scene of an identified trace."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from punctura import Coupling, Membrane, PlacedMembrane, Scene
from punctura.identify.parameters import MEMBRANE, Parameters

DAMPING = 1.0  # N s/m, of the coupling: a servo loop needs some, and slow traces do not show it
SOFTEST_APART = 1e-4  # m: membranes of a scene begin behind this depth


def scene_of(parameters: Parameters, name: str) -> Scene:
    """The identified membranes along -y, for `punctura run`: the first surface is at the origin. Without extensions."""
    coupling = parameters.coupling
    membranes: list[Any] = []
    for i, row in enumerate(parameters.membranes):
        value = dict(zip(MEMBRANE, row.tolist(), strict=True))
        membrane = Membrane(value["stiffness"], value["precompression"], value["friction"], value["thickness"])
        depth = value["surface"] - float(parameters.membranes[0, 0])
        membranes.append(PlacedMembrane(f"membrane {i + 1}", membrane, (0, -depth, 0), (0, -1, 0)))
    return Scene(
        needle=parameters.needle, membranes=membranes, name=name,
        coupling=Coupling(float(coupling[0]), max(float(coupling[1]), DAMPING)),
    )  # fmt: skip


def left_out(names: Sequence[str]) -> str:
    """A comment for the scene file about the extensions that it does not hold; empty if there are none."""
    return f"# Without the extensions of the fit: {', '.join(names)}.\n" if names else ""

"""The scene of an identified trace."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Literal

import numpy as np

from punctura import ConfigurationError, Coupling, MaxwellBranch, Membrane, PlacedMembrane, Scene, Tissue
from punctura._core import DisplaySettings, set_unusual_warnings
from punctura.identify.parameters import COUPLING, MEMBRANE, Parameters

DAMPING = 1.0  # N s/m, of the coupling: a servo loop needs some, and slow traces do not show it
TABLE = 28  # points of a grip that the scene's chords do not follow


def scene_of(parameters: Parameters, name: str) -> Scene:
    """The identified membranes along -y, for `punctura run`: the first surface is at the origin."""
    with _without_unusual_warnings():
        try:
            return _scene(parameters, name, False)
        except ConfigurationError:  # the grip is curved too much for the chords of an exponential grip
            return _scene(parameters, name, True)


@contextmanager
def _without_unusual_warnings() -> Iterator[None]:
    """Nobody wrote these values, so an unusual one is no wrong unit: the trace is what the findings judge.

    In this thread only: filters of `warnings` belong to the whole process, and other threads would lose warnings.
    """
    before = set_unusual_warnings(False)
    try:
        yield
    finally:
        set_unusual_warnings(before)


def _scene(parameters: Parameters, name: str, as_table: bool) -> Scene:
    shared = dict(zip(COUPLING, parameters.coupling.tolist(), strict=True))
    branches = [(shared[f"relaxation_{i}_stiffness"], shared[f"relaxation_{i}_time"]) for i in (1, 2)]
    membranes = []
    for i, row in enumerate(parameters.membranes):
        value = dict(zip(MEMBRANE, row.tolist(), strict=True))
        membrane = Membrane(value["stiffness"], value["precompression"], value["friction"], value["thickness"])
        place = (0.0, float(parameters.membranes[0, 0]) - value["surface"], 0.0)
        tissue = _tissue(value, parameters.needle.diameter, as_table)
        membranes.append(PlacedMembrane(f"membrane {i + 1}", membrane, place, (0, -1, 0), tissue=tissue))
    coupling = Coupling(shared["coupling_stiffness"], max(shared["coupling_damping"], DAMPING))
    relaxation = [MaxwellBranch(stiffness, time) for stiffness, time in branches if stiffness > 0]
    display = DisplaySettings("automatic")  # measured tissue often resists with more than a device can give
    return Scene(name, parameters.needle, coupling, membranes, display=display, relaxation=relaxation)


def _tissue(value: dict[str, float], diameter: float, as_table: bool) -> Tissue:
    growth = value["growth"]
    table: list[tuple[float, float]] = []
    if growth != 0 and as_table:
        opening = np.linspace(0, diameter, TABLE)
        grip = value["precompression"] + value["stiffness"] * np.expm1(growth * opening) / growth
        table = list(zip(opening.tolist(), grip.tolist(), strict=True))
    numbers = {name: number for name, number in value.items() if hasattr(Tissue, name)}
    shape: Literal["linear", "exponential", "table"] = "table" if table else "linear" if growth == 0 else "exponential"
    return Tissue(shape, grip_table=table).replace(**numbers | ({"growth": 0.0} if table else {}))

"""The scenes of the figures. K06 section 4; the values of Fig. 5 are the same."""

from __future__ import annotations

from typing import Literal

from punctura import Coupling, Membrane, Needle, PlacedMembrane, Scene, ServoSettings

Solver = Literal["exact", "paper"]

NEEDLE = Needle(diameter=1.08e-3, tip_angle=0.28)
COUPLING = Coupling(stiffness=400.0, damping=1.0)
INWARD = (0.0, -1.0, 0.0)  # y points up, the needle goes down (docs/errata.md, E1)
_PLACES = {  # thickness and depth of the near face of each membrane, m
    "k06-fig10": [(0.1e-3, 0.0)],
    "k06-fig11": [(4.0e-3, 0.0)],
    "k06-fig12": [(1.0e-3, 0.0), (0.5e-3, 4.0e-3)],
}


def k06_membrane(thickness: float) -> Membrane:
    """The membrane of K06 Fig. 5 and section 4 in a thickness (m)."""
    return Membrane(stiffness=570.0, precompression=0.41, friction=0.2, thickness=thickness)


def k06_scene(name: str, solver: Solver = "exact") -> Scene:
    """The scene of a figure: k06-fig10, k06-fig11 or k06-fig12."""
    placed = [
        PlacedMembrane(f"membrane {i}", k06_membrane(thickness), (0.0, -depth, 0.0), INWARD)
        for i, (thickness, depth) in enumerate(_PLACES[name], 1)
    ]
    return Scene(name, NEEDLE, COUPLING, placed, ServoSettings(solver=solver))


def one_membrane(thickness: float, solver: Solver = "exact") -> Scene:
    """The scene of Fig. 10 with a membrane of another thickness (m)."""
    scene = k06_scene("k06-fig10", solver)
    scene.membranes = [PlacedMembrane("membrane", k06_membrane(thickness), (0.0, 0.0, 0.0), INWARD)]
    return scene

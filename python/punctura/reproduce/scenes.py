"""The scenes of the figures. They come from the package's scene files, the only place with K06's section 4 values."""

from __future__ import annotations

from typing import Literal

from punctura import Membrane, Scene, load_scene

Solver = Literal["exact", "paper"]


def k06_scene(name: str, solver: Solver = "exact") -> Scene:
    """The scene of a figure: k06-fig10, k06-fig11 or k06-fig12."""
    scene = load_scene(name)
    return scene.replace(servo=scene.servo.replace(solver=solver))


_FIG_10 = load_scene("k06-fig10")
NEEDLE = _FIG_10.needle
COUPLING = _FIG_10.coupling
INWARD = _FIG_10.membranes[0].inward_normal  # y points up, the needle goes down (docs/errata.md, E1)


def k06_membrane(thickness: float) -> Membrane:
    """The membrane of K06 Fig. 5 and section 4 with the given thickness (m)."""
    return _FIG_10.membranes[0].membrane.replace(thickness=thickness)


def one_membrane(thickness: float, solver: Solver = "exact") -> Scene:
    """The scene of Fig. 10 with another membrane thickness (m)."""
    scene = k06_scene("k06-fig10", solver)
    placed = scene.membranes[0]
    return scene.replace(membranes=[placed.replace(membrane=k06_membrane(thickness))])

"""A scene of SOFA: a needle of 20 g that a hand pushes through the membranes of a scene of Punctura.

runSofa -l SofaPython3 integrations/sofa/example.py
"""

from __future__ import annotations

from typing import Any

import Sofa
from punctura_sofa import PuncturaController

PLUGINS = (
    "Sofa.Component.ODESolver.Backward", "Sofa.Component.LinearSolver.Iterative", "Sofa.Component.StateContainer",
    "Sofa.Component.Mass", "Sofa.Component.MechanicalLoad",
)  # fmt: skip


class Report(Sofa.Core.Controller):
    """Prints depth and force ten times a second."""

    def __init__(self, *args: Any, needle: Any, force: PuncturaController, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.needle, self.force, self.shown = needle, force, 0.0

    def onAnimateEndEvent(self, event: dict[str, float]) -> None:
        if self.force.time - self.shown >= 0.1:
            self.shown = self.force.time
            y = self.needle.position.value[0][1]
            print(f"{-1e3 * y:6.2f} mm  {self.force.force[1]:6.3f} N")


def createScene(root: Any) -> None:
    root.dt = 0.001
    root.gravity = [0, 0, 0]
    for plugin in PLUGINS:
        root.addObject("RequiredPlugin", name=plugin)
    root.addObject("DefaultAnimationLoop")
    node = root.addChild("needle")
    node.addObject("EulerImplicitSolver", rayleighMass=5)
    node.addObject("CGLinearSolver", iterations=25, tolerance=1e-10, threshold=1e-10)
    # 5 mm in front of the skin; z of the body points down
    turn = [0.7071067811865476, 0, 0, 0.7071067811865476]
    needle = node.addObject("MechanicalObject", template="Rigid3d", position=[[0, 5e-3, 0, *turn]])
    node.addObject("UniformMass", totalMass=0.02)
    node.addObject("ConstantForceField", indices=[0], forces=[[0, -1.2, 0, 0, 0, 0]])  # the hand
    field = node.addObject("ConstantForceField", name="tissue", indices=[0], forces=[[0, 0, 0, 0, 0, 0]])
    force = PuncturaController(name="punctura", needle=needle, field=field, scene="k06-fig12")
    node.addObject(force)
    node.addObject(Report(name="report", needle=needle, force=force))

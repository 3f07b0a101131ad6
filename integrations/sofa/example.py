"""A scene of SOFA: a hand pushes a needle of 20 g through the membranes of a scene of Punctura, and stops.

runSofa -l SofaPython3 integrations/sofa/example.py
"""

from typing import Any

import Sofa
from punctura_sofa import PuncturaController

PLUGINS = (
    "Sofa.Component.ODESolver.Backward", "Sofa.Component.LinearSolver.Iterative", "Sofa.Component.StateContainer",
    "Sofa.Component.Mass", "Sofa.Component.MechanicalLoad",
)  # fmt: skip


class Hand(Sofa.Core.Controller):
    """A spring and a damper between the needle and a point that moves 25 mm down, at 10 mm/s."""

    STIFFNESS, DAMPING = 500.0, 5.0  # N/m, N s/m

    def __init__(self, *args: Any, needle: Any, field: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.needle, self.field, self.force = needle, field, 0.0

    def onAnimateBeginEvent(self, event: dict[str, float]) -> None:
        time = float(self.needle.getContext().time.value)
        target = 5e-3 - min(0.01 * time, 25e-3)
        y, speed = self.needle.position.value[0][1], self.needle.velocity.value[0][1]
        self.force = float(self.STIFFNESS * (target - y) - self.DAMPING * speed)
        with self.field.forces.writeable() as forces:
            forces[0] = [0, self.force, 0, 0, 0, 0]


class Report(Sofa.Core.Controller):
    """Prints depth and force ten times a second."""

    def __init__(self, *args: Any, needle: Any, force: PuncturaController, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.needle, self.force, self.steps = needle, force, 0

    def onAnimateEndEvent(self, event: dict[str, float]) -> None:
        self.steps += 1
        if self.steps % round(0.1 / event["dt"]) == 0:
            y = self.needle.position.value[0][1]
            print(f"{-1e3 * y:6.2f} mm  {self.force.force[1]:6.3f} N")


def createScene(root: Any) -> None:
    root.dt = 0.001
    root.gravity = [0, 0, 0]
    for plugin in PLUGINS:
        root.addObject("RequiredPlugin", pluginName=plugin)
    root.addObject("DefaultAnimationLoop")
    node = root.addChild("needle")
    node.addObject("EulerImplicitSolver")
    # In SI units the numbers of a needle are small: a larger threshold makes SOFA ignore forces below 0.07 N.
    node.addObject("CGLinearSolver", iterations=25, tolerance=1e-12, threshold=1e-20)
    # 5 mm in front of the skin; z of the body points down
    turn = [0.7071067811865476, 0, 0, 0.7071067811865476]
    needle = node.addObject("MechanicalObject", name="body", template="Rigid3d", position=[[0, 5e-3, 0, *turn]])
    node.addObject("UniformMass", totalMass=0.02)
    pushed, tissue = (
        node.addObject("ConstantForceField", name=name, indices=[0], forces=[[0, 0, 0, 0, 0, 0]])
        for name in ("pushed", "tissue")
    )
    force = PuncturaController(name="punctura", needle=needle, field=tissue, scene="k06-fig12")
    node.addObject(Hand(name="hand", needle=needle, field=pushed))
    node.addObject(force)
    node.addObject(Report(name="report", needle=needle, force=force))

"""The controller in SOFA itself: the forces of the core, and the example.   python in_sofa.py REFERENCE"""

import sys
from pathlib import Path

import example
import numpy as np
import punctura as pn
import Sofa.Core
import Sofa.Simulation
from punctura_sofa import PuncturaController, turned


def quaternion(axis: np.ndarray) -> np.ndarray:
    """x, y, z, w of the shortest turn from z to `axis`, which has length 1."""
    q = np.append(np.cross([0, 0, 1], axis), 1 + axis[2])
    return q / np.linalg.norm(q)


def steps(root: Sofa.Core.Node, count: int) -> None:
    for _ in range(count):
        Sofa.Simulation.animate(root, root.dt.value)


def same_forces(reference: Path) -> None:
    """A needle without a solver stands where the test puts it: a step a tick."""
    scene = pn.load_scene(reference / "scene.toml")
    rows = np.fromfile(reference / "motion.f64", "<f8").reshape(-1, 9)
    turns = np.array([quaternion(axis / np.linalg.norm(axis)) for axis in rows[:, 3:6]])
    root = Sofa.Core.Node("root")
    root.dt = 1 / scene.servo.rate
    for plugin in example.PLUGINS:
        root.addObject("RequiredPlugin", pluginName=plugin)
    root.addObject("DefaultAnimationLoop")
    node = root.addChild("needle")
    needle = node.addObject("MechanicalObject", template="Rigid3d", position=[[0, 0, 0, 0, 0, 0, 1]])
    field = node.addObject("ConstantForceField", indices=[0], forces=[[0, 0, 0, 0, 0, 0]])
    node.addObject(PuncturaController(name="punctura", needle=needle, field=field, scene=scene))
    Sofa.Simulation.init(root)
    for again in range(2):
        forces = np.empty((len(rows), 6))
        for k, row in enumerate(rows):
            with needle.position.writeable() as pose:
                pose[0] = [*row[:3], *turns[k]]
            steps(root, 1)
            forces[k] = field.forces.value[0]
        axes = np.array([turned(turn, np.array([0.0, 0.0, 1.0])) for turn in turns])
        core = pn.Insertion(scene).run(rows[:, :3], axes).force
        assert np.array_equal(forces[:, :3], core) and np.ptp(core[:, 1]) > 0.5 and not forces[:, 3:].any(), again
        Sofa.Simulation.reset(root)  # the needle of a reset simulation starts anew
    print(f"sofa: in SOFA itself {len(rows)} forces equal the core's bit for bit, also after a reset")


def whole_example() -> None:
    """The hand of the example pushes the needle in: the field acts on the body, and the needle comes to rest."""
    root = Sofa.Core.Node("root")
    example.createScene(root)
    Sofa.Simulation.init(root)
    needle, felt = root.needle.getObject("body"), root.needle.getObject("punctura")
    largest = 0.0
    for _ in range(5000):
        steps(root, 1)
        largest = max(largest, felt.force[1])
    depth, hand = -needle.position.value[0][1], root.needle.getObject("hand").force
    assert 0.015 < depth < 0.02 and largest > 0.8 and abs(hand + felt.force[1]) < 0.01, (depth, largest, hand)
    print(f"sofa: in the example the needle rests at {1e3 * depth:.1f} mm, held by {felt.force[1]:.3f} N")


same_forces(Path(sys.argv[1]))
whole_example()

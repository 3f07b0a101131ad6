"""The controller's forces are those of the core.   python check.py REFERENCE"""

import sys
from pathlib import Path

import numpy as np
import punctura as pn
from punctura_sofa import PuncturaController, turned
from Sofa import ConstantForceField, MechanicalObject


def quaternion(axis: np.ndarray) -> np.ndarray:
    """x, y, z, w of the shortest turn from z to `axis`, which has length 1."""
    q = np.append(np.cross([0, 0, 1], axis), 1 + axis[2])
    return q / np.linalg.norm(q)


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.append(a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3]), a[3] * b[3] - a[:3] @ b[:3])


reference = Path(sys.argv[1])
scene = pn.load_scene(reference / "scene.toml")
rows = np.fromfile(reference / "motion.f64", "<f8").reshape(-1, 9)
axes = rows[:, 3:6] / np.linalg.norm(rows[:, 3:6], axis=1, keepdims=True)
turns = np.array([quaternion(axis) for axis in axes])
period = {"dt": 1 / scene.servo.rate}

# The tip at the origin of the body, a step a tick: bit for bit.
needle, field = MechanicalObject([0, 0, 0, 0, 0, 0, 1]), ConstantForceField()
controller = PuncturaController(needle=needle, field=field, scene=scene)
forces = np.empty((len(rows), 6))
for k, row in enumerate(rows):
    needle.position.value[0] = [*row[:3], *turns[k]]
    controller.onAnimateBeginEvent(period)
    needle.context.time.value += period["dt"]
    forces[k] = field.forces.value[0]
pointed = np.array([turned(turn, np.array([0.0, 0.0, 1.0])) for turn in turns])
core = pn.Insertion(scene).run(rows[:, :3], pointed).force
assert np.array_equal(forces[:, :3], core) and not forces[:, 3:].any()
print(f"sofa: {len(rows)} forces equal the core's bit for bit")

# A needle whose tip is 80 mm before its centre, in tissue that stands elsewhere, in a world of millimetres.
place = np.append([30.0, -20.0, 5.0], quaternion(np.array([0.48, 0.6, 0.64])))
needle, tissue = MechanicalObject([0, 0, 0, 0, 0, 0, 1]), MechanicalObject(list(place))
field, opposite = ConstantForceField(), ConstantForceField()
controller = PuncturaController(
    needle=needle, field=field, scene=scene, tissue=tissue, tissue_field=opposite, tip=(0, 0, 0.08),
    metres_per_unit=1e-3,
)  # fmt: skip
for k, row in enumerate(rows):
    turn = product(place[3:], turns[k])
    tip = place[:3] + turned(place[3:], row[:3] * 1e3)
    centre = tip - turned(turn, np.array([0, 0, 80.0]))
    needle.position.value[0] = [*centre, *turn]
    controller.onAnimateBeginEvent(period)
    needle.context.time.value += period["dt"]
    assert np.allclose(controller.force, turned(place[3:], core[k]), atol=1e-6), k
    on_needle, on_tissue = field.forces.value[0], opposite.forces.value[0]
    assert np.allclose(on_needle[:3] * 1e-3, controller.force) and np.allclose(on_tissue[:3], -on_needle[:3])
    moments = [np.cross(body[:3], f[:3]) + f[3:] for body, f in (([*centre], on_needle), (place, on_tissue))]
    assert np.allclose(moments[0] + moments[1], 0, atol=1e-6 * max(1, np.abs(moments[0]).max()))
print("sofa: tip, place of the tissue, units and torque are right; the moments of both forces cancel")

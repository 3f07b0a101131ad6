"""Writes the motion and the forces of the core with which every integration compares its own forces.

    python integrations/reference.py FOLDER

FOLDER/scene.toml    the scene
FOLDER/scene.txt     the same scene as lines "path = value", in SI units
FOLDER/motion.f64    one row a tick, 9 doubles, little-endian: position (m), axis, force of the core (N)
FOLDER/depths.f64    2 doubles a tick: depth (m), force of Proxy1d (N) in the scene's first membrane
"""

import sys
from pathlib import Path

import numpy as np
import punctura as pn
from punctura.fmu.description import scene_file_text

SCENE = "k06-fig12"
TICKS = 4000


def motion(rate: float) -> tuple[np.ndarray, np.ndarray]:
    """Three strokes, each deeper and more oblique, with a tremor: in through all membranes, out, and sideways."""
    t = np.arange(TICKS) / rate
    depth = 6e-3 * (1 - np.cos(2 * np.pi * 1.2 * t)) * (0.6 + 0.4 * t) - 1.5e-3
    tilt = 0.25 * np.floor(1.2 * t)
    axis = np.stack([np.sin(tilt), -np.cos(tilt), 0.1 * np.sin(tilt)], axis=1)
    tremor = 2e-5 * np.stack([np.sin(61 * t), np.sin(67 * t), np.sin(71 * t)], axis=1)
    return depth[:, None] * axis + tremor, axis


def main(folder: Path) -> None:
    scene = pn.load_scene(SCENE)
    positions, axes = motion(scene.servo.rate)
    forces = pn.Insertion(scene).run(positions, axes).force
    first = scene.membranes[0].membrane
    proxy = pn.Proxy1d(
        pn.ThickLaw(scene.needle, first), scene.coupling, 1 / scene.servo.rate, solver=scene.servo.solver
    )
    depths = -positions[:, 1]
    line = proxy.run(depths).force
    assert np.ptp(forces[:, 1]) > 0.5 and np.ptp(line) > 0.5
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scene.toml").write_text(pn.scene.scene_text(scene), encoding="utf-8")
    (folder / "scene.txt").write_text(scene_file_text(scene), encoding="utf-8")
    np.hstack([positions, axes, forces]).astype("<f8").tofile(folder / "motion.f64")
    np.stack([depths, line], axis=1).astype("<f8").tofile(folder / "depths.f64")
    print(f"{folder}: {TICKS} ticks, strongest force {np.abs(forces).max():.3f} N")


if __name__ == "__main__":
    main(Path(sys.argv[1]))

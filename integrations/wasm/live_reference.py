"""Writes runs of the core with which test_live.mjs compares those of the page: the ready scenes on a fed device.

    python integrations/wasm/live_reference.py FOLDER

FOLDER/NAME.toml     the scene; NAME.other.toml: the scene that replaces it in the middle of the run
FOLDER/NAME.json     what the studio's server tells its pages of this run: scene, events, estimates
FOLDER/NAME.poses    one row a tick, 6 doubles, little-endian: position (m), axis
FOLDER/NAME.frames   the frame of each tick, with the force of the other solver; before each, its size in bytes (u32,
                     little-endian)
"""

import json
import struct
import sys
from pathlib import Path

import numpy as np
import numpy.typing as npt
from punctura import Scene, load_scene
from punctura._core import (
    DeviceInfo,
    FedDevice,
    GateLimits,
    ServoLoop,
    SimulatedDevice,
    obliquities,
    resting_pose,
)
from punctura.events import EventFinder
from punctura.live import fit_conditioning, stroke_ends
from punctura.scene import scene_names, scene_text
from punctura.simulation import Target
from punctura.studio.followers import Estimator, OtherSolver
from punctura.studio.loaded import from_text
from punctura.studio.view import law_curves, scene_view
from punctura.studio.wire.frames import encode_ticks
from punctura.studio.wire.messages import MembraneEvent
from punctura.ticks import Ticks

TICKS = 4000
EXCHANGE = 2700  # tick from which the other scene runs, in tissue
FAULT = 3900  # tick whose position is not a number


def motion(scene: Scene) -> npt.NDArray[np.float64]:
    """Positions and axes (n, 6): two strokes through all membranes, the second one oblique, with a tremor."""
    t = np.arange(TICKS) / scene.servo.rate
    start, end = np.array(stroke_ends(scene))
    inward = np.array(resting_pose(scene)[1]) if scene.lumen is None else (end - start) / np.linalg.norm(end - start)
    tilt = np.where(t < 1.25, 0.0, 0.2)
    side = np.array([0.0, 0.0, 1.0])
    axis = np.cos(tilt)[:, None] * inward + np.sin(tilt)[:, None] * side
    depth = np.linalg.norm(end - start) * 0.5 * (1 - np.cos(2 * np.pi * 0.8 * t))
    tremor = 2e-5 * np.stack([np.sin(61 * t), np.sin(67 * t), np.sin(71 * t)], axis=1)
    return np.hstack([start + depth[:, None] * axis + tremor, axis])


def run(name: str, folder: Path) -> None:
    text = scene_text(load_scene(name))
    loaded = from_text(text)
    scene = loaded.scene
    other = scene.with_values({"membrane[0].stiffness": 1.5 * scene.membranes[0].membrane.stiffness})
    poses = motion(scene)
    simulated = SimulatedDevice(Target((0, 0, 0)), rate=scene.servo.rate)
    info = simulated.info
    device = FedDevice(
        info.rate,
        info=DeviceInfo(
            has_orientation=True,
            max_force=info.max_force,
            continuous_force=info.continuous_force,
            encoder_step=info.encoder_step,
        ),
        real_time=False,
    )
    fitted, _ = fit_conditioning(scene, device)
    loop = ServoLoop(device, fitted, GateLimits(stale=1.0, deadline=1.0))
    listener = loop.listen()
    finder = EventFinder(loop.scene, info.rate)
    scale = loop.force_scale
    loop.start()
    loop.arm()
    parts: list[Ticks] = []
    for k, pose in enumerate(poses):
        if k == EXCHANGE:
            parts.append(listener.read())
            loop.exchange(fit_conditioning(other, device)[0])
            finder.change(loop.scene)
        device.feed(np.full(3, np.nan) if k == FAULT else pose[:3], pose[3:])
    parts.append(listener.read())
    loop.stop()
    other_solver, estimator = OtherSolver(fitted), Estimator(fitted, info.rate)
    frames, estimates = [], []
    for i, part in enumerate(parts):
        if i == 1:  # as the studio does at an exchange of the scene
            other_solver.take(loop.scene)
            estimator.change(loop.scene)
        for k in range(len(part)):
            tick = part[k : k + 1]
            frames.append(encode_ticks(tick, 7, 0, other_solver.run(tick)))
            if told := estimator.add(tick):
                estimates.append(told)
    assert len(frames) == TICKS
    assert estimates[-1].punctures > 0
    events = [MembraneEvent(**event.model_dump()) for part in parts for event in finder.add(part)]
    assert {event.what for event in events} == {"touch", "pop", "out"}
    axis = np.array(resting_pose(scene)[1])
    view = scene_view(loaded, 0, info.rate, scale, law_curves(scene, obliquities(scene, axis)))
    about = {
        "scene": view.model_dump(mode="json"),
        "estimates": [told.model_dump(mode="json") for told in estimates],
        "events": [event.model_dump(mode="json") for event in events],
        "exchange": EXCHANGE,
        "fault": FAULT,
    }
    (folder / f"{name}.toml").write_text(text, encoding="utf-8")
    (folder / f"{name}.other.toml").write_text(scene_text(other), encoding="utf-8")
    (folder / f"{name}.json").write_text(json.dumps(about), encoding="utf-8")
    poses.astype("<f8").tofile(folder / f"{name}.poses")
    (folder / f"{name}.frames").write_bytes(b"".join(struct.pack("<I", len(frame)) + frame for frame in frames))
    print(f"{name}: {TICKS} ticks, {len(events)} events")


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name in scene_names():
        run(name, folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]))

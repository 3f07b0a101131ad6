"""Measures the felt and the model force of the epidural on a strong and a weak device: docs/felt-force.md.

    python benchmarks/felt_force.py [--picture docs/images/felt-force.png]

Prints the table of the page, and draws its picture. A rigid drive pushes the needle straight in, at a constant speed,
through the servo step of a live run with its limits. Positions have no encoder steps.
"""

import argparse
from pathlib import Path
from typing import NamedTuple

import numpy as np
import punctura as pn
from punctura._core import ForceLimits, GateLimits, Replay
from punctura.events import find_events
from punctura.exercise import load_exercise
from punctura.exercise.losses import Losses
from punctura.exercise.result import Loss
from punctura.exercise.ticks import Geometry
from punctura.live import Limit
from punctura.live.force_words import MODEL_FORCE, felt_force, scale_text
from punctura.reproduce.style import figure_style, new_figure
from punctura.scene import DisplaySettings

DEVICES = {"3.3 N": ForceLimits(), "0.88 N": ForceLimits(max_force=0.88)}
SCALES = (1.0, "automatic")
SPEEDS = (1e-3, 2e-3, 3e-3)  # m/s
WALL = "ligamentum flavum"
START, END, READY_S = 6e-3, -53.5e-3, 1.0  # m; the force has grown after READY_S


class Run(NamedTuple):
    device: str
    speed: float  # m/s
    scene: pn.Scene
    ticks: pn.Ticks
    loss: Loss
    cut_s: float  # time in which a limit cut the force before the pop


def pushed(device: str, display: float | str, speed: float) -> Run:
    """A needle that is pushed from in front of the skin into the epidural space."""
    exercise = load_exercise("epidural")
    scene = exercise.scene.replace(display=DisplaySettings(display))
    rate = scene.servo.rate
    rest = np.full(round(READY_S * rate), START)
    y = np.concatenate([rest, np.arange(START, END, -speed / rate)])
    n = len(y)
    commands = np.zeros(n, np.uint32)
    commands[0] = 1  # arm
    position, axis = np.zeros((n, 3)), np.zeros((n, 3))
    position[:, 1], axis[:, 1] = y, -1
    ticks = Replay(scene, GateLimits(), DEVICES[device]).run(
        {
            "tick": np.arange(n, dtype=np.uint64),
            "time": np.arange(n) / rate,
            "position": position,
            "axis": axis,
            "commands": commands,
            "sequence": np.arange(n, dtype=np.uint64),
            "buttons": np.zeros(n, np.uint32),
            "healthy": np.ones(n, bool),
            "motor_temperature": np.zeros(n),
            "thumb": np.zeros(n),
            "thumb_felt": np.zeros(n),
        },
        [],
    )
    wall = exercise.membrane(WALL)
    losses = Losses(scene, {wall})
    losses.add(Geometry(scene).ticks(ticks), find_events(ticks, scene))
    loss = next(one for one in losses.found if one.membrane == wall)
    before = ticks.time <= loss.time
    limits = (Limit.peak.value, Limit.continuous.value)
    return Run(device, speed, scene, ticks, loss, float((np.isin(ticks.limit, limits) & before).sum()) / rate)


def table(runs: list[Run]) -> str:
    """The table of docs/felt-force.md."""
    lines = [
        "| device | `force_scale` | speed | model force before and after the pop | felt force before and after | "
        "felt loss | needed | force cut before the pop | can be passed |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for run in runs:
        loss = run.loss
        scale = run.scene.display.force_scale
        named = f"automatic: {scale_text(loss.force_scale)}" if scale == "automatic" else f"{scale:g}"
        cells = (
            run.device,
            named,
            f"{run.speed * 1e3:g} mm/s",
            f"{loss.model_before:.2f} N, {loss.model_after:.2f} N",
            f"{loss.before:.2f} N, {loss.after:.2f} N",
            f"{max(loss.drop, 0.0):.2f} N",
            f"{loss.needed:.2g} N",
            f"{run.cut_s:.1f} s",
            "yes" if loss.felt else "**no**",
        )
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def draw(runs: list[Run], path: Path) -> None:
    """Model and felt force against the depth of the needle: one panel for each device and force scale."""
    with figure_style():
        figure = new_figure(5.2)
        axes = figure.subplots(2, 2, sharex=True, sharey=True)
        for row, device in zip(axes, DEVICES, strict=True):
            for panel, display in zip(row, SCALES, strict=True):
                shown = [run for run in runs if run.device == device and run.scene.display.force_scale == display]
                for k, run in enumerate(shown):
                    depth = -1e3 * run.ticks.position[::20, 1]
                    if k == 0:
                        panel.plot(depth, run.ticks.model_force[::20, 1], color="0.65", lw=1.4, label=MODEL_FORCE)
                    panel.plot(depth, run.ticks.force[::20, 1], lw=1.1, label=f"felt, {run.speed * 1e3:g} mm/s")
                panel.set_title(f"{device}: {felt_force(shown[0].loss.force_scale)}")
                panel.legend(loc="upper left")
        for panel in axes[1]:
            panel.set_xlabel("depth of the needle (mm)")
        for row in axes:
            row[0].set_ylabel("force (N)")
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=150)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--picture", type=Path, metavar="FILE")
    arguments = parser.parse_args()
    runs = [pushed(device, scale, speed) for device in DEVICES for scale in SCALES for speed in SPEEDS]
    print(table(runs))
    if arguments.picture:
        draw(runs, arguments.picture)


if __name__ == "__main__":
    main()

"""The video of the example: MuJoCo's picture beside the force over the time."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib
import mujoco
import numpy as np
from PIL import Image

matplotlib.use("agg")
import matplotlib.pyplot as plt

FRAMES_PER_S = 20
SIZE = (300, 400)  # rows and columns of MuJoCo's picture


class Video:
    """Collects frames while the robot moves. MuJoCo draws without a window (MUJOCO_GL=egl or osmesa)."""

    def __init__(self, model: Any, path: Path) -> None:
        self.renderer = mujoco.Renderer(model, *SIZE)
        self.path, self.frames = path, []
        self.figure, self.axes = plt.subplots(figsize=(4, 3), dpi=100, layout="constrained")
        self.axes.set(xlabel="time, s", ylabel="force at the needle's mount, N", xlim=(0, 7), ylim=(-1.2, 2.2))
        self.axes.grid(alpha=0.3)
        [self.line] = self.axes.plot([], [], color="#2f81f7", lw=1.5)

    def look(self, data: Any, rows: list[tuple[float, ...]]) -> None:
        """Takes a frame if it is time for one."""
        if data.time * FRAMES_PER_S < len(self.frames):
            return
        self.renderer.update_scene(data, camera="side")
        time, force = np.array(rows)[:, [0, 2]].T
        self.line.set_data(time, force)
        self.axes.set_title(f"{int(rows[-1][3])} of 2 pops", fontsize=10)
        self.figure.canvas.draw()
        graph = np.asarray(self.figure.canvas.buffer_rgba())[:, :, :3]
        self.frames.append(Image.fromarray(np.hstack([self.renderer.render(), graph])))

    def save(self) -> None:
        """Writes the frames as an animated GIF."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        small = [frame.quantize(64) for frame in self.frames]
        small[0].save(self.path, save_all=True, append_images=small[1:], duration=1000 // FRAMES_PER_S, loop=0)

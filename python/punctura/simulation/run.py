"""Computes the model's force for a given motion: the function simulate."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, overload

import numpy.typing as npt

from punctura._core import Rival, Scene
from punctura.extras import optional
from punctura.progress import Progress, reporting
from punctura.scene import load_scene
from punctura.simulation.arrays import simulate_arrays
from punctura.simulation.summary import SimulationSummary
from punctura.ticks import Ticks


@overload
def simulate(
    scene: Scene | str | os.PathLike[str],
    motion: str | os.PathLike[str],
    out_path: str | os.PathLike[str],
    progress: Progress = None,
    *,
    rivals: Sequence[Rival] | None = None,
) -> SimulationSummary: ...
@overload
def simulate(
    scene: Scene | str | os.PathLike[str],
    motion: npt.NDArray[Any] | Sequence[Any],
    *,
    progress: Progress = None,
    time: npt.ArrayLike | None = None,
    axis: npt.ArrayLike | None = None,
    rivals: Sequence[Rival] | None = None,
) -> Ticks: ...
def simulate(
    scene: Scene | str | os.PathLike[str],
    motion: Any,
    out_path: str | os.PathLike[str] | None = None,
    progress: Progress = None,
    *,
    time: npt.ArrayLike | None = None,
    axis: npt.ArrayLike | None = None,
    rivals: Sequence[Rival] | None = None,
) -> SimulationSummary | Ticks:
    """Computes the model's force for a motion, without safety limits.

    scene: a Scene, a scene file, or the name of a ready scene.

    From file to file: motion is a CSV, Parquet or NumPy file with time_s,x_m,y_m,z_m[,axis_x,axis_y,axis_z], out_path
    a .csv or .parquet file. Files of any length take the same memory. Raises ConfigurationError, MotionError or
    OSError; then, and after Ctrl-C, no output file is left.

    In memory: motion is an array of positions (n, 3), m, or of depths (n,), m, below the first membrane's surface along
    its inward normal. time (n,), s, evenly sampled: the motion is resampled linearly if its rate is not the servo rate.
    Without time each row is one tick. axis (n, 3) or (3,): direction of the needle; default: the first membrane's
    inward normal. Raises ConfigurationError or ValueError. Warns of a depth of more than 0.5 m: the unit is m.

    progress: a function of the finished share, 0 to 1, or True for a bar. rivals: force models of other
    authors instead of the scene's law (punctura.rivals), one, or one for each membrane.
    """
    if motion is None:
        raise TypeError("motion must be an array of positions, m, or the name of a motion file, not None")
    if not isinstance(motion, (str, os.PathLike)):
        if out_path is not None:
            raise TypeError(
                "the third argument, out_path, is for motion files; with a motion in memory, write axis=... or "
                "time=..., and save the result with save()"
            )
        return simulate_arrays(
            scene if isinstance(scene, Scene) else load_scene(scene), motion, time, axis, progress, rivals
        )
    if time is not None or axis is not None:
        raise TypeError("time and axis are for a motion in memory only; a motion file has columns for them")
    if out_path is None:
        raise TypeError("a motion file needs out_path, a .csv or .parquet file for the result")
    optional("pyarrow", "files", "simulate with a motion file")
    from punctura.simulation.from_file import simulate_file

    loaded = scene if isinstance(scene, Scene) else load_scene(scene)
    name = scene.name if isinstance(scene, Scene) else str(scene)
    with reporting(progress, "simulate") as report:
        return simulate_file(name, loaded, Path(motion), Path(out_path), report, rivals)

"""The simulation: reads a block, runs the model over it, writes a block."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple, overload

import numpy as np
import numpy.typing as npt
from numpy.typing import NDArray

from punctura._core import Insertion, Rival, RivalInsertion, Scene
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.progress import Progress, Tell, reporting
from punctura.scene import load_scene, scene_text
from punctura.simulation.arrays import simulate_arrays
from punctura.simulation.depth_note import depth_note
from punctura.simulation.even import Evenness
from punctura.simulation.motion_error import TABLES, MotionError
from punctura.simulation.motion_file import MotionFile
from punctura.simulation.motion_table import MotionTable
from punctura.simulation.rate import resampler_for
from punctura.simulation.resample import ROWS_AT_ONCE, Resampler, unit, with_axis
from punctura.simulation.summary import MembraneSummary, SimulationSummary
from punctura.simulation.table import output_schema, output_table
from punctura.ticks import Ticks
from punctura.ticks.files import SUFFIXES, open_output

Array = NDArray[np.float64]

FARTHEST = 1e6  # m: positions farther away are rejected
_SURVEY_SHARE = 0.2  # share of the progress for the first pass


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

    progress: a function of the finished share, 0 to 1, or True for a bar on a terminal. rivals: force models of other
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
    with reporting(progress, "simulate") as tell:
        return _simulate_file(scene, Path(motion), Path(out_path), tell, rivals)


def _simulate_file(
    scene: Scene | str | os.PathLike[str], source: Path, target: Path, tell: Tell, rivals: Sequence[Rival] | None
) -> SimulationSummary:
    began = perf_counter()
    name = scene.name if isinstance(scene, Scene) else str(scene)
    scene = scene if isinstance(scene, Scene) else load_scene(scene)
    _check_target(source, target)

    motion = MotionTable(source) if source.suffix.lower() in TABLES else MotionFile(source)
    even = _survey(motion, tell)
    summary = SimulationSummary(name, str(source), str(target), servo_rate_hz=scene.servo.rate)
    summary.rows_in = even.count
    summary.membranes = [MembraneSummary(placed.name) for placed in scene.membranes]
    resampler = _resampler(even, scene, summary)

    insertion = Insertion(scene) if rivals is None else RivalInsertion(scene, rivals)
    metadata = {"punctura.scene": scene_text(scene)}
    schema = output_schema(motion.has_axis, len(scene.membranes), metadata)
    default_axis = np.array(scene.membranes[0].inward_normal)
    with open_output(target, schema) as output:
        for part in _parts(motion, resampler, tell):
            trace = insertion.run(part.position, default_axis if part.axis is None else part.axis)
            output.write(output_table(schema, part.time, part.position, part.axis, trace))
            _add(summary, part, trace)
    deepest = max(summary.membranes, key=lambda membrane: membrane.deepest_m)
    summary.notes += filter(None, [depth_note(deepest.name, deepest.deepest_m)])
    summary.elapsed_s = perf_counter() - began
    return summary


class _Part(NamedTuple):
    """Rows that the model processes together."""

    time: Array
    position: Array
    axis: Array | None


def _check_target(source: Path, target: Path) -> None:
    problems = []
    if not source.is_file():
        reason = "is not a file" if source.exists() else "there is no such file"
        problems.append(Problem(f"motion {source}", MISSING, reason))
    if target.suffix.lower() not in SUFFIXES:
        problems.append(Problem(f"out {target}", MISSING, f"must end in {' or '.join(SUFFIXES)}"))
    if target.is_dir():
        problems.append(Problem(f"out {target}", MISSING, "is a folder"))
    elif not target.parent.is_dir():
        problems.append(Problem(f"out {target}", MISSING, f"there is no folder {target.parent}"))
    elif source.exists() and target.exists() and source.samefile(target):
        problems.append(Problem(f"out {target}", MISSING, "is the motion file itself; choose another name"))
    if problems:
        raise ConfigurationError(problems)


def _survey(motion: MotionFile | MotionTable, tell: Tell) -> Evenness:
    """Reads the whole motion once, so that errors are found before the computation."""
    even = Evenness(motion.path)
    for block in motion.blocks():
        even.add(block.first_line, block.time)
        far = np.flatnonzero((np.abs(block.position) > FARTHEST).any(axis=1))
        if len(far):
            line = block.first_line + int(far[0])
            raise MotionError(motion.path, line, "x_m, y_m, z_m must be within 1000 km; write them in metres")
        if block.axis is not None:
            nowhere = np.flatnonzero(~block.axis.any(axis=1))
            if len(nowhere):
                line = block.first_line + int(nowhere[0])
                raise MotionError(motion.path, line, "axis_x, axis_y, axis_z are all 0; they must give a direction")
        tell(_SURVEY_SHARE * block.bytes_read / motion.size)
    even.finish()
    if not even.count:
        raise MotionError(motion.path, 2, "there is no motion below the column names")
    return even


def _resampler(even: Evenness, scene: Scene, summary: SimulationSummary) -> Resampler | None:
    """The resampler if one is needed. Adds a note to the summary."""
    resampler = resampler_for(even, scene.servo.rate)
    if even.step is None:
        return None
    summary.motion_rate_hz = 1 / even.step
    if resampler is not None:
        summary.resampled = True
        summary.notes.append(
            f"the motion is sampled at {1 / even.step:.6g} Hz, the servo runs at {scene.servo.rate:.6g} Hz: "
            "the motion was resampled linearly"
        )
    return resampler


def _parts(motion: MotionFile | MotionTable, resampler: Resampler | None, tell: Tell) -> Iterator[_Part]:
    for block in motion.blocks():
        for i in range(0, len(block.time), ROWS_AT_ONCE):
            rows = slice(i, i + ROWS_AT_ONCE)
            position, axis = block.position[rows], None if block.axis is None else block.axis[rows]
            if resampler is None:
                yield _Part(block.time[rows], position, axis)
            else:
                for stamps, values in resampler.add(position if axis is None else with_axis(position, axis)):
                    yield _Part(stamps, values[:, :3], None if axis is None else unit(values[:, 3:]))
            tell(_SURVEY_SHARE + (1 - _SURVEY_SHARE) * block.bytes_read / motion.size)


def _add(summary: SimulationSummary, part: _Part, trace: Ticks) -> None:
    if not summary.rows_out:
        summary.start_s = float(part.time[0])
    summary.rows_out += len(part.time)
    summary.end_s = float(part.time[-1])
    summary.strongest_N = max(summary.strongest_N, float(np.linalg.norm(trace.force, axis=1).max()))
    for i, membrane in enumerate(summary.membranes):
        membrane.deepest_m = max(membrane.deepest_m, float(trace.depth[:, i].max()))
        membrane.strongest_N = max(membrane.strongest_N, float(np.abs(trace.axial_force[:, i]).max()))

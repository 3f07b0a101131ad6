"""Simulates from file to file, in constant memory."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from punctura._core import Insertion, Rival, RivalInsertion, Scene
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.whole_file import same_file, target_problems
from punctura.progress import Report
from punctura.scene import scene_text
from punctura.simulation.columns import TABLES, MotionError
from punctura.simulation.motion_file import MotionFile
from punctura.simulation.motion_table import MotionTable
from punctura.simulation.resample import ROWS_AT_ONCE, Evenness, Resampler, resampler_for, unit, with_axis
from punctura.simulation.summary import MembraneSummary, SimulationSummary, depth_note
from punctura.ticks import FIELDS, Ticks
from punctura.ticks.fields import shape_of
from punctura.ticks.files import SUFFIXES, open_output

Array = NDArray[np.float64]

FARTHEST = 1e6  # m: positions farther away are rejected
_SURVEY_SHARE = 0.2  # share of the progress for the first pass
WRITTEN = ("time", "position", "axis", "force", "depth", "axial_force", "lower", "upper", "phase")


def output_schema(has_axis: bool, membranes: int, metadata: dict[str, str]) -> pa.Schema:
    """Names and types of the output's columns."""
    names = [name for name in WRITTEN if has_axis or name != "axis"]
    none = Ticks({name: np.empty(shape_of(FIELDS[name], 0, membranes), FIELDS[name].dtype) for name in names})
    schema = none.to_arrow().schema
    return pa.schema([field.with_nullable(False) for field in schema], metadata)


def output_table(schema: pa.Schema, time: Array, position: Array, axis: Array | None, ticks: Ticks) -> pa.Table:
    """One block of the result. position and axis are written unchanged."""
    given = {"time": time, "position": position} | ({} if axis is None else {"axis": axis})
    written = {name: given[name] if name in given else ticks[name] for name in WRITTEN if name != "axis"}
    table = Ticks(written | given).to_arrow()
    return pa.Table.from_arrays([column.combine_chunks() for column in table.select(schema.names)], schema=schema)


def simulate_file(
    name: str, scene: Scene, source: Path, target: Path, progress: Report, rivals: Sequence[Rival] | None
) -> SimulationSummary:
    """See simulate. name: of the scene, for the summary."""
    began = perf_counter()
    _check_target(source, target)

    motion = MotionTable(source) if source.suffix.lower() in TABLES else MotionFile(source)
    even = _survey(motion, progress)
    summary = SimulationSummary(name, str(source), str(target), rate_hz=scene.servo.rate)
    summary.samples = even.count
    summary.membranes = [MembraneSummary(placed.name) for placed in scene.membranes]
    resampler = _resampler(even, scene, summary)

    insertion = Insertion(scene) if rivals is None else RivalInsertion(scene, rivals)
    metadata = {"punctura.scene": scene_text(scene)}
    schema = output_schema(motion.has_axis, len(scene.membranes), metadata)
    default_axis = np.array(scene.membranes[0].inward_normal)
    with open_output(target, schema) as output:
        for part in _parts(motion, resampler, progress):
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
    problems = [Problem(f"out {target}", MISSING, reason) for reason in target_problems(target, SUFFIXES)]
    if not source.is_file():
        reason = "is not a file" if source.exists() else "there is no such file"
        problems.insert(0, Problem(f"motion {source}", MISSING, reason))
    elif same_file(source, target):
        problems.append(Problem(f"out {target}", MISSING, "is the motion file itself; choose another name"))
    if problems:
        raise ConfigurationError(problems)


def _survey(motion: MotionFile | MotionTable, progress: Report) -> Evenness:
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
        progress(_SURVEY_SHARE * block.bytes_read / motion.size)
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


def _parts(motion: MotionFile | MotionTable, resampler: Resampler | None, progress: Report) -> Iterator[_Part]:
    for block in motion.blocks():
        for i in range(0, len(block.time), ROWS_AT_ONCE):
            rows = slice(i, i + ROWS_AT_ONCE)
            position, axis = block.position[rows], None if block.axis is None else block.axis[rows]
            if resampler is None:
                yield _Part(block.time[rows], position, axis)
            else:
                for stamps, values in resampler.add(position if axis is None else with_axis(position, axis)):
                    yield _Part(stamps, values[:, :3], None if axis is None else unit(values[:, 3:]))
            progress(_SURVEY_SHARE + (1 - _SURVEY_SHARE) * block.bytes_read / motion.size)


def _add(summary: SimulationSummary, part: _Part, trace: Ticks) -> None:
    if not summary.ticks:
        summary.start_s = float(part.time[0])
    summary.ticks += len(part.time)
    summary.end_s = float(part.time[-1])
    summary.peak_N = max(summary.peak_N, float(np.linalg.norm(trace.force, axis=1).max()))
    for i, membrane in enumerate(summary.membranes):
        membrane.deepest_m = max(membrane.deepest_m, float(trace.depth[:, i].max()))
        membrane.peak_N = max(membrane.peak_N, float(np.abs(trace.axial_force[:, i]).max()))

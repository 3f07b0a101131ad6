"""Compares runs in a process of its own, at low priority: `python -m punctura.compare.worker`, for the studio.

Reads one job as JSON from standard input. Writes a LabLine for each run; last, the result or the error.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Literal, TypeAlias

import numpy as np
from pydantic import BaseModel, Field

from punctura.compare.background import step_back
from punctura.compare.comparison import Band, Collector, Comparison, Summary
from punctura.compare.motion import recorded_motion, stroke, vary
from punctura.compare.run import MOST_TICKS, Array, Run, recorded_run
from punctura.compare.statistics import Statistics
from punctura.defects import PATIENCE_S, explain
from punctura.record import Recording
from punctura.record.header import from_text
from punctura.record.recording import read_recording
from punctura.results import JsonObject

DIGITS = 6


class Variation(BaseModel):
    """A parameter (SI) through a list of values, with a stroke (m/s) or the motion of a recording."""

    scene: str  # a scene file's text
    path: str
    values: list[float]
    speed: float = 5e-3
    recording: str = ""  # path of the file


class Job(BaseModel):
    """Runs to compare: recordings (name and path of the file), or a variation."""

    on: Literal["depth", "time"] = "depth"
    recordings: list[tuple[str, str]] = Field(default=[])
    variation: Variation | None = None
    zip: str = ""  # path of the zip file to write; without it, the comparison is printed


class LabBand(BaseModel):
    """A quantity of all runs, and its mean, on a common axis. SI, with DIGITS digits; None where there is no value."""

    x: list[float]
    runs: list[list[float | None]]
    mean: list[float | None]
    deviation: list[float | None]  # n - 1
    count: list[int]  # the number of runs that have a value


class MembraneBand(LabBand):
    """The resistance of a membrane."""

    name: str


class LabCurves(BaseModel):
    """The curves of a comparison, as Comparison has them."""

    bands: dict[str, LabBand]
    membranes: list[MembraneBand]


class LabComparison(BaseModel):
    """A comparison against depth and against time."""

    statistics: list[Statistics]
    differences: list[dict[str, float | None]]  # what each run's numbers have more than the first run's
    summary: dict[str, Summary]
    depth: LabCurves
    time: LabCurves


class LabProgress(BaseModel):
    """The run that is computed now, and the share of the work that is done."""

    share: float
    run: str


class LabResult(BaseModel):
    """The last line."""

    comparison: LabComparison


class LabFailure(BaseModel):
    """The last line of a computation that failed."""

    error: str


LabLine: TypeAlias = LabProgress | LabResult | LabFailure
Report: TypeAlias = Callable[[LabProgress], None]


def do(job: Job, report: Report) -> LabComparison | None:
    """Does a job; returns the comparison; None if it wrote a zip file.

    Raises ValueError, RecordingError, OSError.
    """
    count = len(job.recordings) or len(job.variation.values if job.variation else [])
    runs = _reported(_varied(job.variation) if job.variation else _recorded(job.recordings), count, report)
    if job.zip:
        from punctura.compare.bundle import check_ticks, save_bundle  # matplotlib takes long to import

        check_ticks(sum(read_recording(path, lambda one: one.rows) for _, path in job.recordings))
        title = f"A variation of {job.variation.path}" if job.variation else "A comparison of recordings"
        save_bundle(runs, job.zip, job.on, title)
        return None
    collectors = (Collector("depth"), Collector("time"))
    for run in runs:
        for collector in collectors:
            collector.add(run)
    depth, time = (collector.comparison() for collector in collectors)
    return LabComparison(
        statistics=depth.statistics,
        differences=[depth.difference(row) for row in range(count)],
        summary=depth.summary(),
        depth=_curves(depth),
        time=_curves(time),
    )


def _reported(runs: Iterable[Run], count: int, report: Report) -> Iterator[Run]:
    for done, run in enumerate(runs):
        report(LabProgress(share=done / count, run=run.name))
        yield run


def _recorded(recordings: list[tuple[str, str]]) -> Iterator[Run]:
    for name, path in recordings:
        yield read_recording(path, partial(_run, name=name))


def _run(recording: Recording, name: str) -> Run:
    if recording.rows > MOST_TICKS:
        raise ValueError(f"{name} has {recording.rows} ticks; at most {MOST_TICKS} can be compared")
    return recorded_run(recording, name)


def _varied(asked: Variation) -> Iterator[Run]:
    scene = from_text(asked.scene, Path("the scene"))
    motion = read_recording(asked.recording, recorded_motion) if asked.recording else stroke(scene, asked.speed)
    return vary(scene, asked.path, asked.values, motion)


def _curves(comparison: Comparison) -> LabCurves:
    each = zip(comparison.names, comparison.membranes, strict=False)
    return LabCurves(
        bands={name: LabBand(**_band(band)) for name, band in comparison.bands.items()},
        membranes=[MembraneBand(name=name, **_band(band)) for name, band in each],
    )


def _band(band: Band) -> JsonObject:
    return {
        "x": _numbers(band.x),
        "runs": [_numbers(row) for row in band.runs],
        "mean": _numbers(band.mean),
        "deviation": _numbers(band.deviation),
        "count": band.count.tolist(),
    }


def _numbers(values: Array) -> list[float | None]:
    return [float(f"{v:.{DIGITS}g}") if np.isfinite(v) else None for v in values]


def main() -> None:
    """Does the job on standard input."""
    step_back()

    def report(line: LabLine) -> None:
        print(line.model_dump_json(), flush=True)

    try:
        if comparison := do(Job.model_validate_json(sys.stdin.read()), report):
            report(LabResult(comparison=comparison))
    except Exception as error:
        report(LabFailure(error=explain(error, PATIENCE_S)))


if __name__ == "__main__":
    main()

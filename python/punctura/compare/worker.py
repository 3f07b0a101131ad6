"""Compares runs in a process of its own, at low priority: `python -m punctura.compare.worker`, for the studio.

Reads one job as JSON from standard input. Writes JSON lines: {"share", "run"} before each run, then {"comparison"} or
{"error"}.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, Literal, TypedDict

import numpy as np
from pydantic import BaseModel, Field

from punctura.compare.background import step_back
from punctura.compare.comparison import Band, Collector, Comparison
from punctura.compare.motion import recorded_motion, stroke
from punctura.compare.run import MOST_TICKS, Array, Run, recorded_run
from punctura.compare.vary import vary
from punctura.defects import PATIENCE_S, explain
from punctura.record import Recording
from punctura.record.recording import read_recording
from punctura.record.scene_text import from_text
from punctura.results import JsonObject

DIGITS = 6
Tell = Callable[[float, str], None]


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


class BandRecord(TypedDict):
    """A quantity of all runs, and its mean, on a common axis. SI; None where there is no value."""

    x: list[float | None]
    runs: list[list[float | None]]
    mean: list[float | None]
    deviation: list[float | None]
    count: list[int]


class MembraneRecord(BandRecord):
    """The resistance of a membrane."""

    name: str


class CurvesRecord(TypedDict):
    """The curves of a comparison."""

    bands: dict[str, BandRecord]
    membranes: list[MembraneRecord]


class CompareRecord(TypedDict):
    """A comparison: the numbers of each run (Statistics), their differences and summary, and the curves."""

    statistics: list[JsonObject]
    differences: list[dict[str, float | None]]
    summary: dict[str, JsonObject]
    depth: CurvesRecord
    time: CurvesRecord


def do(job: Job, tell: Tell) -> CompareRecord | None:
    """Does a job; returns the comparisons as JSON, against depth and against time; None if it wrote a zip file.

    Raises ValueError, RecordingError, OSError.
    """
    count = len(job.recordings) or len(job.variation.values if job.variation else [])
    runs = _told(_varied(job.variation) if job.variation else _recorded(job.recordings), count, tell)
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
    return {
        "statistics": [one.model_dump() | {"drop": one.drop, "overshoot": one.overshoot} for one in depth.statistics],
        "differences": [depth.difference(row) for row in range(count)],
        "summary": {name: one._asdict() for name, one in depth.summary().items()},
        "depth": as_json(depth),
        "time": as_json(time),
    }


def _told(runs: Iterable[Run], count: int, tell: Tell) -> Iterator[Run]:
    for done, run in enumerate(runs):
        tell(done / count, run.name)
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


def as_json(comparison: Comparison) -> CurvesRecord:
    """The curves of a comparison as JSON values, with DIGITS digits; null where there is no value."""
    each = zip(comparison.names, comparison.membranes, strict=False)
    return {
        "bands": {name: _band(band) for name, band in comparison.bands.items()},
        "membranes": [{"name": name, **_band(band)} for name, band in each],
    }


def _band(band: Band) -> BandRecord:
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

    def say(**words: Any) -> None:
        print(json.dumps(words), flush=True)

    try:
        job = Job.model_validate_json(sys.stdin.read())
        say(comparison=do(job, lambda share, run: say(share=share, run=run)) or {})
    except Exception as error:
        say(error=explain(error, PATIENCE_S))


if __name__ == "__main__":
    main()

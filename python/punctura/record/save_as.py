"""Exports a recording, finished or not, to CSV, Parquet or MCAP."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from punctura.files.whole_file import whole_file
from punctura.record.pieces import export_steps
from punctura.record.recording import open_recording
from punctura.record.target import check_target

SUFFIXES = (".csv", ".parquet", ".mcap")
Progress = Callable[[float], None]


@dataclass
class ExportResult:
    """The exported file, the number of ticks, and notes for the reader."""

    file: str
    out: str
    ticks: int
    lost: int
    notes: list[str] = field(default_factory=list)


def export(path: str | os.PathLike[str], out: str | os.PathLike[str], progress: Progress | None = None) -> ExportResult:
    """Writes all ticks to `out`. Replaces an existing file, unless it is a recording, once the new one is complete.

    Raises RecordingError, ConfigurationError for an invalid `out`, ModuleNotFoundError if the mcap package is missing.
    """
    target = Path(out)
    check_target(Path(path), target, SUFFIXES)
    recording = open_recording(path)
    result = ExportResult(str(recording.path), str(target), recording.rows, recording.lost, list(recording.notes))
    kind = target.suffix.lower()[1:]
    if kind == "csv" and recording.summary.new_scenes:
        result.notes.append("CSV cannot hold the scenes; bit 8 of commands marks the ticks that took a new one")
    with whole_file(target, private=True) as place, open(place, "wb") as file:
        for _ in export_steps(recording, kind, file, progress):
            pass
    return result

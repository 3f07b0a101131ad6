"""A recording, finished or not, as CSV, Parquet or MCAP."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from punctura.files.whole_file import whole_file
from punctura.record.pieces import export_steps
from punctura.record.recording import open_recording
from punctura.record.target import check_target

SUFFIXES = (".csv", ".parquet", ".mcap")
Progress = Callable[[float], None]


@dataclass
class ExportResult:
    """What went out, and what its reader should know."""

    file: str
    out: str
    ticks: int
    lost: int
    notes: list[str] = field(default_factory=list)

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


def export(path: str | os.PathLike[str], out: str | os.PathLike[str], progress: Progress | None = None) -> ExportResult:
    """Writes all ticks to `out`; a file there, unless it is a recording, is replaced when the new one is whole.

    Raises RecordingError, ConfigurationError for an `out` that cannot be, ModuleNotFoundError without the mcap package.
    """
    target = Path(out)
    check_target(Path(path), target, SUFFIXES)
    recording = open_recording(path)
    result = ExportResult(str(recording.path), str(target), recording.rows, recording.lost, list(recording.notes))
    kind = target.suffix.lower()[1:]
    if kind == "csv" and recording.summary["new_scenes"]:
        result.notes.append("a CSV has no place for the scenes; commands has bit 8 where a new one was taken")
    with whole_file(target, replace=True) as place, open(place, "wb") as file:
        for _ in export_steps(recording, kind, file, progress):
            pass
    return result

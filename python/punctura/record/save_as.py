"""A recording, finished or not, as CSV, Parquet or MCAP."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import pyarrow as pa

from punctura.record.columns import NEW_SCENES
from punctura.record.mcap_file import write_mcap
from punctura.record.parquet_file import parquet_output
from punctura.record.recording import Recording, open_recording
from punctura.record.target import check_target
from punctura.simulation.output import open_output

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
    suffix = target.suffix.lower()
    if suffix == ".csv":
        if recording.summary["new_scenes"]:
            result.notes.append("a CSV has no place for the scenes; commands has bit 8 where a new one was taken")
        _to_csv(recording, target, progress)
    elif suffix == ".parquet":
        _to_parquet(recording, target, progress)
    else:
        write_mcap(recording, target, progress)
    return result


def _to_csv(recording: Recording, target: Path, progress: Progress | None) -> None:
    schema = pa.schema([f for f in recording.schema if f.name != NEW_SCENES])
    with open_output(target, schema) as output:
        for batch in recording.batches(progress):
            output.write(pa.Table.from_batches([batch]).select(schema.names))


def _to_parquet(recording: Recording, target: Path, progress: Progress | None) -> None:
    summary = {"summary": recording.summary | {"notes": list(recording.notes), "damaged": recording.damaged}}
    with parquet_output(target, recording.schema, recording.info.data | summary) as output:
        for batch in recording.batches(progress):
            output.write(batch)

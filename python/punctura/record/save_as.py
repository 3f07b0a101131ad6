"""Exports a recording, finished or not, to CSV, Parquet or MCAP: as a file, or piece by piece."""

import itertools
import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pyarrow as pa

from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.whole_file import same_file, target_problems, whole_file
from punctura.progress import Report
from punctura.record.collected import Collected
from punctura.record.columns import NEW_SCENES, in_pieces
from punctura.record.description import RecordingError
from punctura.record.mcap_file import mcap_steps
from punctura.record.parquet_file import parquet_steps
from punctura.record.recording import Recording, open_recording
from punctura.ticks.files import CsvOutput


def check_target(source: Path, target: Path, suffixes: Sequence[str]) -> None:
    """Raises ConfigurationError for an invalid path or an existing recording. Recordings are never overwritten."""
    problems = target_problems(target, suffixes)
    if same_file(source, target):
        problems.append("is the recording itself")
    elif _is_recording(target):
        problems.append("is already a recording, which is never overwritten: delete it, or choose another name")
    if problems:
        raise ConfigurationError([Problem(f"out {target}", MISSING, problem) for problem in problems])


def _is_recording(file: Path) -> bool:
    if file.suffix.lower() != ".parquet" or not file.exists():
        return False
    try:
        open_recording(file)
    except RecordingError:
        return False
    return True


PIECE_BYTES = 1 << 18


def export_pieces(recording: Recording, kind: str) -> Iterator[bytes]:
    """Yields the bytes of the exported file. Never holds the whole file, neither on disk nor in memory."""
    out = Collected()
    for _ in itertools.chain(export_steps(recording, kind, out), (None,)):  # one more turn for the last bytes
        data = out.take()
        for at in range(0, len(data), PIECE_BYTES):
            yield data[at : at + PIECE_BYTES]


def export_steps(recording: Recording, kind: str, out: Any, progress: Report | None = None) -> Iterator[None]:
    """Writes to the open file `out`, one piece per step. kind: csv, parquet or mcap.

    Raises RecordingError, and ModuleNotFoundError if the mcap package is missing.
    """
    return _STEPS[kind](recording, out, progress)


def _csv_steps(recording: Recording, out: Any, progress: Report | None) -> Iterator[None]:
    schema = pa.schema([f for f in recording.schema if f.name != NEW_SCENES])
    output = CsvOutput(out, schema)
    yield
    for batch in in_pieces(recording.batches(progress)):
        output.write(pa.Table.from_batches([batch]).select(schema.names))
        yield


def _parquet_steps(recording: Recording, out: Any, progress: Report | None) -> Iterator[None]:
    summary = recording.summary.model_dump() | {"notes": list(recording.notes), "damaged": recording.damaged}
    data = recording.info.data | {"summary": summary}
    return parquet_steps(recording.batches(progress), out, recording.schema, data)


_STEPS: dict[str, Callable[[Recording, Any, Report | None], Iterator[None]]] = {
    "csv": _csv_steps,
    "parquet": _parquet_steps,
    "mcap": mcap_steps,
}


SUFFIXES = (".csv", ".parquet", ".mcap")


@dataclass
class ExportResult:
    """The exported file, the number of ticks, and notes for the reader."""

    file: str  # the recording
    out: str  # the file written
    ticks: int  # written
    lost: int  # that the recording lacks
    notes: list[str] = field(default_factory=list)  # for the reader


def export(path: str | os.PathLike[str], out: str | os.PathLike[str], progress: Report | None = None) -> ExportResult:
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

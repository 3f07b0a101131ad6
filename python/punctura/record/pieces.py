"""Exports a recording piece by piece, as bytes or to an open file."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from typing import Any

import pyarrow as pa

from punctura.record.collected import Collected
from punctura.record.columns import NEW_SCENES
from punctura.record.mcap_file import mcap_steps
from punctura.record.parquet_file import parquet_steps
from punctura.record.recording import Recording
from punctura.record.schema import in_pieces
from punctura.ticks.files import CsvOutput

PIECE_BYTES = 1 << 18
Progress = Callable[[float], None]


def export_pieces(recording: Recording, kind: str) -> Iterator[bytes]:
    """Yields the bytes of the exported file. Never holds the whole file, neither on disk nor in memory."""
    out = Collected()
    for _ in itertools.chain(export_steps(recording, kind, out), (None,)):  # one more turn for the last bytes
        data = out.take()
        for at in range(0, len(data), PIECE_BYTES):
            yield data[at : at + PIECE_BYTES]


def export_steps(recording: Recording, kind: str, out: Any, progress: Progress | None = None) -> Iterator[None]:
    """Writes to the open file `out`, one piece per step. kind: csv, parquet or mcap.

    Raises RecordingError, and ModuleNotFoundError if the mcap package is missing.
    """
    return _STEPS[kind](recording, out, progress)


def _csv_steps(recording: Recording, out: Any, progress: Progress | None) -> Iterator[None]:
    schema = pa.schema([f for f in recording.schema if f.name != NEW_SCENES])
    output = CsvOutput(out, schema)
    yield
    for batch in in_pieces(recording.batches(progress)):
        output.write(pa.Table.from_batches([batch]).select(schema.names))
        yield


def _parquet_steps(recording: Recording, out: Any, progress: Progress | None) -> Iterator[None]:
    summary = recording.summary.model_dump() | {"notes": list(recording.notes), "damaged": recording.damaged}
    data = recording.info.data | {"summary": summary}
    return parquet_steps(recording.batches(progress), out, recording.schema, data)


_STEPS: dict[str, Callable[[Recording, Any, Progress | None], Iterator[None]]] = {
    "csv": _csv_steps,
    "parquet": _parquet_steps,
    "mcap": mcap_steps,
}

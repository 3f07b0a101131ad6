"""A recording in another format, as bytes to send on: nothing of it is kept in a file or as a whole in memory."""

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
from punctura.simulation.output import CsvOutput

PIECE_BYTES = 1 << 18


def export_pieces(recording: Recording, kind: str) -> Iterator[bytes]:
    """kind: csv, parquet or mcap. Raises RecordingError, ModuleNotFoundError without the mcap package."""
    out = Collected()
    for _ in itertools.chain(_STEPS[kind](recording, out), (None,)):  # once more for what the end has written
        data = out.take()
        for at in range(0, len(data), PIECE_BYTES):
            yield data[at : at + PIECE_BYTES]


def _csv_steps(recording: Recording, out: Any) -> Iterator[None]:
    schema = pa.schema([f for f in recording.schema if f.name != NEW_SCENES])
    output = CsvOutput(out, schema)
    yield
    for batch in in_pieces(recording.batches()):
        output.write(pa.Table.from_batches([batch]).select(schema.names))
        yield


def _parquet_steps(recording: Recording, out: Any) -> Iterator[None]:
    summary = recording.summary | {"notes": list(recording.notes), "damaged": recording.damaged}
    return parquet_steps(recording.batches(), out, recording.schema, recording.info.data | {"summary": summary})


_STEPS: dict[str, Callable[[Recording, Any], Iterator[None]]] = {
    "csv": _csv_steps,
    "parquet": _parquet_steps,
    "mcap": mcap_steps,
}

"""Finished recordings: Parquet files with the run description in their metadata."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from punctura.files.whole_file import whole_file
from punctura.progress import Report
from punctura.record.description import RecordingError
from punctura.record.header import from_metadata, to_metadata
from punctura.record.stream import BROKEN
from punctura.ticks.files import ParquetOutput, parquet_output_to

_ROWS_A_GROUP = 1 << 15  # maximum
_GROUP_BYTES = 32 << 20  # approximate; a tick of 64 membranes takes 6 kB


class ParquetRecording:
    """Reads a finished recording."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.notes: list[str] = []
        with self._open() as file:
            self.schema = file.schema_arrow.remove_metadata()
            self.info = from_metadata(file.schema_arrow, path)
            self.rows = file.metadata.num_rows

    def batches(self, progress: Report | None = None) -> Iterator[pa.RecordBatch]:
        with self._open() as file:
            done = 0
            try:
                for batch in file.iter_batches(batch_size=rows_a_group(self.schema)):
                    batch.validate(full=True)
                    yield batch.replace_schema_metadata(None)
                    done += len(batch)
                    if progress:
                        progress(done / max(1, self.rows))
            except BROKEN as bad:
                raise RecordingError(f"{self.path} is damaged after {done} ticks: {bad}") from None

    def _open(self) -> pq.ParquetFile:
        try:
            return pq.ParquetFile(str(self.path), page_checksum_verification=True)
        except BROKEN as bad:
            raise RecordingError(f"{self.path} cannot be read, or is damaged: {bad}") from None


def rows_a_group(schema: pa.Schema) -> int:
    """Number of rows per row group, which are in memory together."""
    return max(256, min(_ROWS_A_GROUP, _GROUP_BYTES // (8 * len(schema))))


@contextmanager
def parquet_output(
    path: Path, schema: pa.Schema, data: Mapping[str, object], replace: bool = True
) -> Iterator[ParquetOutput]:
    """Writes a finished recording. The file gets its name only when it is complete; an error leaves no file.

    replace: see whole_file.
    """
    schema = schema.with_metadata(to_metadata(data, schema))
    with whole_file(path, replace, private=True) as place, _output(place, schema) as output:
        yield output


def parquet_steps(
    batches: Iterable[pa.RecordBatch], out: Any, schema: pa.Schema, data: Mapping[str, object]
) -> Iterator[None]:
    """Writes a finished recording to an open file, batch by batch."""
    schema = schema.with_metadata(to_metadata(data, schema))
    with _output(out, schema) as output:
        for batch in batches:
            output.write(batch)
            yield


def _output(where: Any, schema: pa.Schema) -> AbstractContextManager[ParquetOutput]:
    return parquet_output_to(
        where,
        schema,
        rows_a_group(schema),
        compression="zstd",
        use_byte_stream_split=[f.name for f in schema if pa.types.is_floating(f.type)],
        write_page_checksum=True,
    )

"""The form of a recording while it is written: Arrow IPC streams, one after the other, each batch with a check sum.

Any Arrow library reads the first stream of such a file. A second one begins only where a new scene has more membranes.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from typing import Any

import pyarrow as pa
import pyarrow.ipc

from punctura.record.collected import Collected
from punctura.record.header import is_sound, to_metadata

CHECK = b"crc32"
END = b"\xff\xff\xff\xff\0\0\0\0"  # of a stream that was ended in order
# What pyarrow raises for bytes that are no stream.
BROKEN = (pa.ArrowException, OSError, ValueError, KeyError, MemoryError, OverflowError)


def check_sum(batch: pa.RecordBatch) -> bytes:
    """Over the bytes of the batch as they stand in the file."""
    return str(zlib.crc32(batch.serialize())).encode()


class Encoder:
    """Turns batches into bytes to append."""

    def __init__(self, header: dict[str, Any]) -> None:
        self._header = header
        self._out = Collected()
        self._writer: pa.RecordBatchStreamWriter | None = None
        self.schema: pa.Schema | None = None

    def begin(self, schema: pa.Schema) -> bytes:
        """A stream for these columns; the one before, if any, is ended."""
        if self._writer is not None:
            self._writer.close()
        self.schema = schema.with_metadata(to_metadata(self._header, schema))
        self._writer = pa.ipc.new_stream(self._out, self.schema)
        return self.batch(pa.RecordBatch.from_pylist([], self.schema))  # without a batch, nothing would be written yet

    def batch(self, batch: pa.RecordBatch) -> bytes:
        assert self._writer is not None and self.schema is not None
        batch = batch.replace_schema_metadata(self.schema.metadata)
        try:
            self._writer.write_batch(batch, custom_metadata={CHECK: check_sum(batch)})
        except BaseException:
            self._out.take()  # half a batch must not stand before the next one
            raise
        return self._out.take()

    def end(self) -> bytes:
        """The mark that the recording was ended in order."""
        if self._writer is not None:
            self._writer.close()
            self._writer = None
        return self._out.take()


class Decoder:
    """The batches of a file in turn. `damaged` counts those whose check sum is wrong; `broken`: what ended it."""

    def __init__(self, file: pa.NativeFile, size: int) -> None:
        self._file, self._size = file, size
        self.damaged = 0
        self.broken = ""
        self._sound_to = self._largest = 0  # bytes: where the last part that could be read ends, and the largest
        self.schemas: list[pa.Schema] = []

    def __iter__(self) -> Iterator[pa.RecordBatch]:
        try:
            while self._file.tell() < self._size:
                yield from self._stream()
        except BROKEN as bad:
            self.broken = str(bad).splitlines()[0] if str(bad) else type(bad).__name__

    @property
    def broken_inside(self) -> bool:
        """More is left than one part that was being written when the process ended."""
        return bool(self.broken) and self._size - self._sound_to > 2 * self._largest

    def _stream(self) -> Iterator[pa.RecordBatch]:
        reader = pa.ipc.open_stream(self._file)
        if self.schemas and not is_sound(reader.schema):
            raise ValueError("the columns are not as they were written")
        self.schemas.append(reader.schema)
        while True:
            try:
                batch, metadata = reader.read_next_batch_with_custom_metadata()
            except StopIteration:
                return
            end = self._file.tell()
            self._sound_to, self._largest = end, max(self._largest, end - self._sound_to)
            if self._sound(batch, metadata):
                yield batch
            else:
                self.damaged += 1

    @staticmethod
    def _sound(batch: pa.RecordBatch, metadata: Any) -> bool:
        try:
            batch.validate(full=True)
            return metadata is not None and metadata.get(CHECK) == check_sum(batch)
        except BROKEN:
            return False

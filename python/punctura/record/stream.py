"""Format of a .part file: Arrow IPC streams, one after the other, with a checksum for each batch.

Any Arrow library reads the first stream. A further stream begins when a new scene has more membranes.
"""

import zlib
from collections.abc import Iterator, Mapping
from typing import Any

import pyarrow as pa
import pyarrow.ipc

from punctura.record.collected import Collected
from punctura.record.header import is_sound, to_metadata

CHECK = b"crc32"
_MESSAGE = b"\xff\xff\xff\xff"  # before the length of each message
END = _MESSAGE + b"\0\0\0\0"  # end mark of a complete stream
_LONGEST_SCHEMA = 1 << 26  # bytes, with the description of the run
# Exceptions of pyarrow for bytes that are not a stream.
BROKEN = (pa.ArrowException, OSError, ValueError, KeyError, MemoryError, OverflowError)


def begins_stream(beginning: bytes) -> bool:
    """Whether the first 8 bytes of a file can be those of a stream.

    Arrow also takes the first four bytes of a text for a length, and takes as much memory.
    """
    return beginning.startswith(_MESSAGE) and 0 < int.from_bytes(beginning[4:8], "little") <= _LONGEST_SCHEMA


def check_sum(batch: pa.RecordBatch) -> bytes:
    """Checksum of the batch's bytes in the file."""
    return str(zlib.crc32(batch.serialize())).encode()


class Encoder:
    """Encodes batches as bytes."""

    def __init__(self, header: Mapping[str, object]) -> None:
        self._header = header
        self._out = Collected()
        self._writer: pa.RecordBatchStreamWriter | None = None
        self.schema: pa.Schema | None = None

    def begin(self, schema: pa.Schema) -> bytes:
        """Starts a stream with these columns and ends the previous one."""
        if self._writer is not None:
            self._writer.close()
        self.schema = schema.with_metadata(to_metadata(self._header, schema))
        self._writer = pa.ipc.new_stream(self._out, self.schema)
        return self.batch(pa.RecordBatch.from_pylist([], self.schema))  # Arrow writes the schema with the first batch

    def batch(self, batch: pa.RecordBatch) -> bytes:
        assert self._writer is not None and self.schema is not None
        batch = batch.replace_schema_metadata(self.schema.metadata)
        try:
            self._writer.write_batch(batch, custom_metadata={CHECK: check_sum(batch)})
        except BaseException:
            self._out.take()  # discard the incomplete batch
            raise
        return self._out.take()

    def end(self) -> bytes:
        """The end mark of a complete recording."""
        if self._writer is not None:
            self._writer.close()
            self._writer = None
        return self._out.take()


class Decoder:
    """Yields the batches of a file. `damaged` counts wrong checksums; `broken` is the error that ended the reading."""

    def __init__(self, file: pa.NativeFile, size: int) -> None:
        self._file, self._size = file, size
        self.damaged = 0
        self.broken = ""
        self._sound_to = self._largest = 0  # bytes: end of the last readable part, and size of the largest part
        self.schemas: list[pa.Schema] = []

    def __iter__(self) -> Iterator[pa.RecordBatch]:
        try:
            while self._file.tell() < self._size:
                yield from self._stream()
        except BROKEN as bad:
            self.broken = str(bad).splitlines()[0] if str(bad) else type(bad).__name__

    @property
    def broken_inside(self) -> bool:
        """Whether more data follows the last readable part than one incomplete write."""
        return bool(self.broken) and self._size - self._sound_to > 2 * self._largest

    def _stream(self) -> Iterator[pa.RecordBatch]:
        reader = pa.ipc.open_stream(self._file)
        if self.schemas and not is_sound(reader.schema):
            raise ValueError("the checksum of the columns is wrong")
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

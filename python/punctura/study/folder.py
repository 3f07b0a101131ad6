"""The folder of a study: its chunks, the table of all trials, and the lock."""

from __future__ import annotations

import errno
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from punctura import PuncturaError
from punctura.files.whole_file import whole_file, write_whole
from punctura.record.lock import lock

TABLE = "trials.parquet"


class StudyError(PuncturaError):
    """A study cannot be run or replayed; the text says why and what to do."""


class Folder:
    """The files of one study. Every file appears only when it is complete."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.table = path / TABLE

    @contextmanager
    def locked(self) -> Iterator[None]:
        """Only one run at a time may use the folder. Raises StudyError."""
        descriptor = None
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            descriptor = self._lock_file()
            if lock(descriptor) is False:
                raise StudyError(f"{self.path}: another run of this study is going on; wait for it")
            yield
        except OSError as error:
            raise self._told(error) from None
        finally:
            if descriptor is not None:
                os.close(descriptor)

    def _told(self, error: OSError) -> Exception:
        """The error with what to do, if it is of this folder."""
        place = Path(os.fsdecode(error.filename)) if isinstance(error.filename, str | bytes) else self.path
        if error.errno in (errno.ENOSPC, errno.EDQUOT):
            advice = "the disk is full. Finished chunks are kept: free some space and give the same command again"
        elif self.path in (place, *place.parents) or place in self.path.parents:
            advice = f"cannot be written ({error.strerror}): give another folder with --out"
        else:
            return error
        return StudyError(f"{place}: {advice}")

    def _lock_file(self) -> int:
        path = self.path / "lock"
        try:  # a link could create a file in another folder
            return os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o666)
        except OSError as error:
            if error.errno != errno.ELOOP:
                raise
            raise StudyError(f"{path} is a symbolic link: delete it, and give the same command again") from None

    def claim(self, digest: str) -> None:
        """Marks the folder as that of one plan. Raises StudyError if it holds the trials of another one."""
        mark = self.path / "study.json"
        if mark.exists():
            try:
                known = json.loads(mark.read_bytes()).get("digest")
            except (ValueError, AttributeError):
                known = None
            if known == digest:
                return
            if self.table.exists() or any(self.path.glob("chunk-*.parquet")):
                raise StudyError(
                    f"{self.path} holds the trials of another plan, scene or version of Punctura: give another --out, "
                    "or delete this folder"
                )
        write_whole(mark, json.dumps({"digest": digest}).encode())

    def chunk(self, number: int) -> Path:
        return self.path / f"chunk-{number:06}.parquet"

    def has(self, number: int, first: int, rows: int) -> bool:
        """Whether a chunk is there with these rows, not damaged."""
        return _holds(self.chunk(number), range(first, first + rows))

    def is_complete(self, rows: int) -> bool:
        """Whether the table of all trials is there, not damaged."""
        return _holds(self.table, range(rows))

    def save(self, number: int, table: pa.Table) -> None:
        """Writes a chunk."""
        sink = pa.BufferOutputStream()
        pq.write_table(table, sink, write_page_checksum=True)
        write_whole(self.chunk(number), sink.getvalue().to_pybytes())

    def join(self, chunks: int) -> None:
        """Writes the table of all trials from the chunks, in order, and deletes the chunks."""
        with (
            whole_file(self.table) as place,
            pq.ParquetWriter(place, pq.read_schema(self.chunk(0)), write_page_checksum=True) as writer,
        ):
            for number in range(chunks):
                writer.write_table(pq.read_table(self.chunk(number)))
        self.drop_chunks()

    def drop_chunks(self) -> None:
        for path in self.path.glob("chunk-*.parquet"):
            path.unlink()


def _holds(path: Path, rows: range) -> bool:
    """Whether a file has exactly these rows, and every page the right checksum."""
    try:
        with pq.ParquetFile(path, page_checksum_verification=True) as file:
            begin = rows.start
            for i in range(file.num_row_groups):
                group = file.read_row_group(i)
                count = len(group)
                if not np.array_equal(group["row"].to_numpy(), np.arange(begin, begin + count)):
                    return False
                begin += count
            return begin == rows.stop
    except (OSError, pa.ArrowException, KeyError):
        return False

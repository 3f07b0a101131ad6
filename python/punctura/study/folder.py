"""The folder of a study: its chunks, the table of all trials, and the lock."""

import errno
import json
import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from punctura import PuncturaError
from punctura.errors import FREE_SPACE, NoSuchFileError, is_full
from punctura.files.whole_file import whole_file, write_whole
from punctura.record.new_file import lock

TABLE = "trials.parquet"
MARK = b"punctura.study"  # in the schema of each file: the digest of the plan whose rows it holds


class StudyError(PuncturaError):
    """A study cannot be run or replayed; the text says why and what to do."""


class NoSuchRowError(StudyError, NoSuchFileError):
    """The plan has no row of this number."""


class StudyWarning(UserWarning):
    """A file of a study is not used."""


class Folder:
    """The files of one study. Every file appears only when it is complete."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.table = path / TABLE
        self._mark = path / "study.json"
        self._schema = pa.schema([])

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
            raise self._with_advice(error) from None
        finally:
            if descriptor is not None:
                os.close(descriptor)

    def _with_advice(self, error: OSError) -> Exception:
        """The error with what to do, if it is of this folder."""
        place = Path(os.fsdecode(error.filename)) if isinstance(error.filename, str | bytes) else self.path
        if is_full(error):
            advice = f"the disk is full. Finished chunks are kept: {FREE_SPACE} and give the same command again"
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

    def claim(self, schema: pa.Schema) -> None:
        """Marks the folder as that of one plan. schema: of its rows, with its digest (MARK).

        A file states its plan itself; study.json speaks for one that is too damaged. Raises StudyError, and changes
        nothing, if a file has trials of another plan or does not state a plan.
        """
        self.check(schema)
        self._schema = schema
        if self._named() != schema.metadata[MARK].decode():
            write_whole(self._mark, json.dumps({"digest": schema.metadata[MARK].decode()}).encode())

    def check(self, schema: pa.Schema) -> None:
        """Raises StudyError if a file of the folder has trials of another plan, or does not state its plan."""
        wanted = schema.metadata[MARK]
        for path in [self.table, *sorted(self.path.glob("chunk-*.parquet"))]:
            if not path.exists():
                continue
            try:
                found = (pq.read_schema(path).metadata or {}).get(MARK)
                why = "does not state its plan: an older Punctura wrote it, or another program"
            except (OSError, pa.ArrowException):
                found = (self._named() or "").encode() or None
                why = "cannot be read, and study.json does not say that it is of this plan"
            if found is not None and found != wanted:
                why = "holds the trials of another plan, scene or version of Punctura"
            if found != wanted:
                raise StudyError(f"{path} {why}. Give another --out, or move this file away and give the command again")

    def _named(self) -> str | None:
        """The digest in study.json; None without a readable one."""
        try:
            named = json.loads(self._mark.read_bytes())["digest"]
        except (FileNotFoundError, ValueError, KeyError, TypeError):
            return None
        return named if isinstance(named, str) else None

    def chunk(self, number: int) -> Path:
        return self.path / f"chunk-{number:06}.parquet"

    def has(self, number: int, first: int, rows: int) -> bool:
        """Whether a chunk is there with these rows, not damaged."""
        return _holds(self.chunk(number), self._schema, range(first, first + rows))

    def is_complete(self, rows: int) -> bool:
        """Whether the table of all trials is there, not damaged."""
        return _holds(self.table, self._schema, range(rows))

    def save(self, number: int, table: pa.Table) -> None:
        """Writes a chunk."""
        sink = pa.BufferOutputStream()
        pq.write_table(table.cast(self._schema), sink, write_page_checksum=True)
        write_whole(self.chunk(number), sink.getvalue().to_pybytes())

    def join(self, chunks: int) -> None:
        """Writes the table of all trials from the chunks, in order, and deletes the chunks."""
        with (
            whole_file(self.table) as place,
            pq.ParquetWriter(place, self._schema, write_page_checksum=True) as writer,
        ):
            for number in range(chunks):
                writer.write_table(pq.read_table(self.chunk(number)))
        self.drop_chunks()

    def drop_chunks(self) -> None:
        for path in self.path.glob("chunk-*.parquet"):
            path.unlink()


def _holds(path: Path, schema: pa.Schema, rows: range) -> bool:
    """Whether a file has these columns and rows, and every page the right checksum. Warns if it has not."""
    try:
        with pq.ParquetFile(path, page_checksum_verification=True) as file:
            good = bool(file.schema_arrow.equals(schema, check_metadata=False))
            begin = rows.start
            for i in range(file.num_row_groups if good else 0):
                group = file.read_row_group(i)
                good = good and np.array_equal(group["row"].to_numpy(), np.arange(begin, begin + len(group)))
                begin += len(group)
            good = good and begin == rows.stop
    except FileNotFoundError:
        return False
    except (OSError, pa.ArrowException):
        good = False
    if not good:
        warnings.warn(f"{path} is damaged or was changed: its trials are computed again", StudyWarning, stacklevel=2)
    return good

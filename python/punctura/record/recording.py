"""Reads a recording, finished or not."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from punctura.progress import Report
from punctura.record.columns import numbers, ticks_of
from punctura.record.description import FaultAt, MissingRecordingError, RecordingError, Summary
from punctura.record.finish import finished_path, part_path
from punctura.record.header import RecordingInfo
from punctura.record.parquet_file import ParquetRecording
from punctura.record.part_file import PartFile
from punctura.record.stream import begins_stream
from punctura.ticks import Ticks

_PARQUET = b"PAR1"
T = TypeVar("T")


class Recording:
    """All ticks of a run. `notes` names the parts of the file that could not be read."""

    def __init__(self, path: Path, source: PartFile | ParquetRecording) -> None:
        self.path = path
        self._source = source
        self.finished = isinstance(source, ParquetRecording)
        self.info: RecordingInfo = source.info
        self.schema: pa.Schema = source.schema
        self.summary: Summary = (
            source.survey.summary(source.notes, source.damaged)
            if isinstance(source, PartFile)
            else source.info.header.summary
        )
        self.notes: tuple[str, ...] = tuple(source.notes) + tuple(self._earlier_notes())

    def __repr__(self) -> str:
        return f"<Recording {str(self.path)!r}: {self.rows} ticks, {self.lost} lost, finished={self.finished}>"

    @property
    def rows(self) -> int:
        """Number of ticks in the file."""
        return self._source.survey.rows if isinstance(self._source, PartFile) else self._source.rows

    @property
    def lost(self) -> int:
        """Number of ticks known to be missing."""
        return self.summary.lost

    @property
    def damaged(self) -> bool:
        """Whether ticks that had been written are missing from the file."""
        return self.summary.damaged

    @property
    def faults(self) -> list[FaultAt]:
        """The first 1000 faults, each with its tick, name and meaning."""
        return self.summary.faults

    def batches(self, progress: Report | None = None) -> Iterator[pa.RecordBatch]:
        """Yields all ticks in order, in constant memory. progress is called with the completed share, 0 to 1."""
        return self._source.batches(progress)

    def ticks(self) -> Ticks:
        """All ticks at once, as arrays."""
        names = [placed.name for placed in self.info.scene.membranes]
        return Ticks(dict(ticks_of(self.table().combine_chunks()).items()), names)

    def table(self) -> pa.Table:
        """All ticks at once as an Arrow table, with the scenes taken during the run."""
        return pa.Table.from_batches(list(self.batches()), self.schema)

    def column(self, name: str) -> NDArray[Any]:
        """One column as numbers. null becomes NaN; a state, fault or phase becomes its code, 255 if absent."""
        if name not in self.schema.names:
            raise RecordingError(f"{self.path} has no column {name!r}; it has {', '.join(self.schema.names)}")
        parts = [numbers(batch, name) for batch in self.batches()]
        return np.concatenate(parts) if parts else np.empty(0)

    def _earlier_notes(self) -> list[str]:
        """Notes from the conversion of the unfinished file to this one."""
        return self.summary.notes if self.finished else []


def open_recording(path: str | os.PathLike[str]) -> Recording:
    """Opens a recording: finished, still running, or left by a killed process. Raises RecordingError.

    Opens `path`.part if `path` does not exist.
    """
    file = Path(path)
    if not file.exists() and part_path(file).exists():
        file = part_path(file)
    try:
        if not stat.S_ISREG(kind := file.stat().st_mode) and not stat.S_ISDIR(kind):  # opening a pipe would block
            raise RecordingError(f"{file} is a pipe or a device, not a recording")
        with file.open("rb") as head:
            beginning = head.read(8)
        finished = beginning.startswith(_PARQUET)
        if not finished and not begins_stream(beginning):
            raise RecordingError(f"{file} is not a recording of Punctura, or its beginning is damaged")
        return Recording(file, ParquetRecording(file) if finished else PartFile(file))
    except FileNotFoundError:
        raise MissingRecordingError(f"{file}: there is no such file") from None
    except IsADirectoryError:
        raise RecordingError(f"{file} is a folder, not a recording") from None
    except OSError as bad:
        raise RecordingError(f"{file} cannot be read: {bad.strerror or bad}") from None


def read_recording(path: str | os.PathLike[str], act: Callable[[Recording], T]) -> T:
    """What `act` returns for the recording at `path`. Raises RecordingError and what `act` raises."""
    return read_found(partial(find_recording, Path(path)), lambda file: act(open_recording(file)))


def read_found(find: Callable[[], Path], act: Callable[[Path], T]) -> T:
    """What `act` returns for the path from `find`. If `act` fails and `find` now returns another path, `act` gets that.

    So a recording can be read while it is finished, which replaces its .part file. Raises what `find` and `act` raise.
    """
    path = find()
    try:
        return act(path)
    except (RecordingError, OSError):
        now = find()
        if now == path:
            raise
        return act(now)


def find_recording(path: Path) -> Path:
    """The existing file of a recording, given its path or that of its .part file; `path` if there is neither."""
    finished = finished_path(path)
    # The finished file is last, and so a second time: the recording may have been finished after the first look.
    candidates = (path, part_path(finished), finished)
    return next((file for file in candidates if file.is_file()), path)

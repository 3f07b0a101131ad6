"""A recording, finished or not, for those who read it."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from punctura.record.errors import RecordingError
from punctura.record.finish import part_path
from punctura.record.header import RecordingInfo
from punctura.record.parquet_file import ParquetRecording
from punctura.record.part_file import PartFile
from punctura.record.schema import numbers, ticks_of
from punctura.ticks import Ticks

_PARQUET = b"PAR1"


class Recording:
    """Every tick of a run. `notes` says what of the file could not be read."""

    def __init__(self, path: Path, source: PartFile | ParquetRecording) -> None:
        self.path = path
        self._source = source
        self.finished = isinstance(source, ParquetRecording)
        self.info: RecordingInfo = source.info
        self.schema: pa.Schema = source.schema
        self.summary: dict[str, Any] = (
            source.survey.to_dict() if isinstance(source, PartFile) else source.info.said.summary.model_dump()
        )
        self.notes: tuple[str, ...] = tuple(source.notes) + tuple(self._earlier_notes())

    def __repr__(self) -> str:
        return f"<Recording {str(self.path)!r}: {self.rows} ticks, {self.lost} lost, finished={self.finished}>"

    @property
    def rows(self) -> int:
        """Ticks in the file."""
        return self._source.survey.rows if isinstance(self._source, PartFile) else self._source.rows

    @property
    def lost(self) -> int:
        """Ticks that are known to be missing."""
        return int(self.summary["lost"])

    @property
    def damaged(self) -> bool:
        """Ticks are missing that had been written: the file is not as it was."""
        return self._source.damaged if isinstance(self._source, PartFile) else bool(self.summary["damaged"])

    @property
    def faults(self) -> list[dict[str, Any]]:
        """The first thousand, each with its tick, name and meaning."""
        return list(self.summary["faults"])

    def batches(self, progress: Callable[[float], None] | None = None) -> Iterator[pa.RecordBatch]:
        """All ticks in turn, in constant memory. progress is told the share done."""
        return self._source.batches(progress)

    def ticks(self) -> Ticks:
        """All ticks at once, as arrays."""
        names = [placed.name for placed in self.info.scene.membranes]
        return Ticks(dict(ticks_of(self.table().combine_chunks()).items()), names)

    def table(self) -> pa.Table:
        """All ticks at once, as Arrow has them, with the scenes that were taken."""
        return pa.Table.from_batches(list(self.batches()), self.schema)

    def column(self, name: str) -> NDArray[Any]:
        """One column as numbers: null is NaN; a state, fault or phase is its code, 255 for none."""
        if name not in self.schema.names:
            raise RecordingError(f"{self.path} has no column {name!r}; it has {', '.join(self.schema.names)}")
        parts = [numbers(batch, name) for batch in self.batches()]
        return np.concatenate(parts) if parts else np.empty(0)

    def _earlier_notes(self) -> list[str]:
        """What was noted when an unfinished file was turned into this one."""
        return list(self.summary["notes"]) if self.finished else []


def open_recording(path: str | os.PathLike[str]) -> Recording:
    """A finished recording, or one whose process was killed or still runs. Raises RecordingError.

    Where there is no `path` but a `path`.part, that is opened.
    """
    file = Path(path)
    if not file.exists() and part_path(file).exists():
        file = part_path(file)
    try:
        if not stat.S_ISREG(kind := file.stat().st_mode) and not stat.S_ISDIR(kind):  # a pipe would block
            raise RecordingError(f"{file} is a pipe or a device, not a recording")
        with file.open("rb") as head:
            finished = head.read(len(_PARQUET)) == _PARQUET
        return Recording(file, ParquetRecording(file) if finished else PartFile(file))
    except FileNotFoundError:
        raise RecordingError(f"{file}: there is no such file") from None
    except IsADirectoryError:
        raise RecordingError(f"{file} is a folder, not a recording") from None
    except OSError as bad:
        raise RecordingError(f"{file} cannot be read: {bad.strerror or bad}") from None

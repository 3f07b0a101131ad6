"""Reads an unfinished recording: its process was killed or is still running."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pyarrow as pa

from punctura.record.errors import RecordingError
from punctura.record.header import from_metadata
from punctura.record.schema import check_columns, read_schema, worded
from punctura.record.stream import BROKEN, END, Decoder
from punctura.record.survey import Survey

Progress = Callable[[float], None]


class PartFile:
    """Scans the whole file when it is opened. Incomplete data is left out and noted."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._size = path.stat().st_size
        self.survey = Survey()
        self.notes: list[str] = []
        self.damaged = False  # whether ticks that had been written are missing
        with pa.OSFile(os.fsencode(path), "rb") as file:
            decoder = Decoder(file, self._size)
            checked = 0
            for batch in decoder:
                if checked < len(decoder.schemas):  # a new stream
                    checked = len(decoder.schemas)
                    self.info = from_metadata(decoder.schemas[0], path)
                    check_columns(decoder.schemas[-1], path)
                self._check_order(batch)
                self.survey.add(batch)
        if not decoder.schemas:
            raise RecordingError(f"{path} is not a recording of Punctura, or its beginning is damaged")
        if not checked:
            self.info = from_metadata(decoder.schemas[0], path)
        self.damaged_parts = decoder.damaged
        self.schema = read_schema(max(decoder.schemas, key=len))
        self._note(decoder)

    def batches(self, progress: Progress | None = None) -> Iterator[pa.RecordBatch]:
        """The ticks that were in the file when it was opened."""
        left = self.survey.rows
        with pa.OSFile(os.fsencode(self.path), "rb") as file:
            for batch in Decoder(file, self._size):
                if left <= 0:
                    return
                yield self._worded(batch[:left])
                left -= len(batch)
                if progress:
                    progress(min(1.0, file.tell() / max(1, self._size)))

    def _worded(self, batch: pa.RecordBatch) -> pa.RecordBatch:
        try:
            return worded(batch, self.schema)
        except BROKEN as bad:
            raise RecordingError(f"{self.path} is damaged: invalid code of a state, fault or phase: {bad}") from None

    def _check_order(self, batch: pa.RecordBatch) -> None:
        try:
            tick = batch.column("tick").to_numpy()
            sound = len(tick) == 0 or (tick[0] > self.survey.last_tick and (tick[1:] > tick[:-1]).all())
        except BROKEN:
            sound = False
        if not sound:
            raise RecordingError(f"{self.path} is damaged: its ticks are not in order")

    def _ended(self) -> bool:
        with self.path.open("rb") as file:
            file.seek(max(0, self._size - len(END)))
            return file.read(len(END)) == END

    def _note(self, decoder: Decoder) -> None:
        whole = f"complete up to tick {self.survey.last_tick}" if self.survey.rows else "without a tick"
        self.damaged = decoder.broken_inside or decoder.damaged > 0
        if decoder.broken_inside:
            self.notes.append(
                f"the file is damaged inside; data after the damage was left out; the recording is {whole}"
            )
        elif decoder.broken:
            self.notes.append(f"the end of the file is truncated or damaged and was left out; the recording is {whole}")
        elif not self._ended():
            self.notes.append(f"the recording was not finished; it is {whole}")
        if decoder.damaged:
            self.notes.append(f"{decoder.damaged} damaged parts of the file were left out; their ticks are missing")

"""Reads an unfinished recording: its process was killed or is still running."""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa

from punctura._core import Fault, describe
from punctura.progress import Report
from punctura.record.columns import check_columns, numbers, read_schema, worded
from punctura.record.description import FaultAt, RecordingError, Summary
from punctura.record.header import from_metadata
from punctura.record.stream import BROKEN, END, Decoder

_MOST_FAULTS = 1000  # in the list; all faults are counted


class Survey:
    """Counts over batches, given in order."""

    def __init__(self) -> None:
        self.rows = 0
        self.first_tick = self.last_tick = -1
        self.missing = 0  # missing ticks, including those before the first row
        self.scenes = 0  # ticks that took a new scene
        self.fault_count = 0
        self.faults: list[FaultAt] = []
        self._fault = 0

    def add(self, batch: pa.RecordBatch) -> None:
        if len(batch) == 0:
            return
        tick = numbers(batch, "tick").astype(np.int64)
        if self.rows == 0:
            self.first_tick = int(tick[0])
            self.missing += int(numbers(batch, "lost")[0])
            before = self.first_tick - 1
        else:
            before = self.last_tick
        self.missing += int((np.diff(tick, prepend=before) - 1).sum())
        self.rows += len(tick)
        self.last_tick = int(tick[-1])
        self.scenes += len(batch) - batch.column("new_scenes").null_count
        self._add_faults(tick, numbers(batch, "fault"))

    def _add_faults(self, tick: Any, fault: Any) -> None:
        before = np.concatenate(([self._fault], fault[:-1]))
        self._fault = int(fault[-1])
        for k in np.flatnonzero((fault != 0) & (fault != before)):
            self.fault_count += 1
            if len(self.faults) < _MOST_FAULTS:
                self.faults.append(_fault_at(int(tick[k]), int(fault[k])))

    def summary(self, notes: Sequence[str] = (), damaged: bool = False) -> Summary:
        """The summary for the run description."""
        return Summary(
            ticks=self.rows,
            first_tick=self.first_tick,
            last_tick=self.last_tick,
            lost=self.missing,
            new_scenes=self.scenes,
            fault_count=self.fault_count,
            faults=self.faults,
            notes=list(notes),
            damaged=damaged,
        )


def _fault_at(tick: int, fault: int) -> FaultAt:
    if fault >= len(Fault):
        return FaultAt(tick=tick, fault=str(fault), meaning="unknown to this version")
    kind = Fault(fault)
    return FaultAt(tick=tick, fault=kind.name, meaning=describe(kind))


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

    def batches(self, progress: Report | None = None) -> Iterator[pa.RecordBatch]:
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

"""Counts ticks, missing ticks and faults of a recording in one pass."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pyarrow as pa

from punctura._core import Fault, describe
from punctura.record.description import FaultAt, Summary
from punctura.record.schema import numbers

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

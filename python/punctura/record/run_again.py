"""Runs a recording again: the same inputs through the same servo step must give the same forces, to the last bit."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from punctura._core import Replay, Scene
from punctura.record.build_id import build_id
from punctura.record.columns import LOST, NEW_SCENES, Columns
from punctura.record.parquet_file import parquet_output
from punctura.record.recording import Recording, open_recording
from punctura.record.scene_text import from_text
from punctura.record.schema import input_ticks, membranes_in, numbers, raw_batch, worded
from punctura.record.target import check_target
from punctura.ticks import COMMAND_SCENE
from punctura.ticks.flat import flatten


@dataclass
class ReplayResult:
    """How many ticks were computed again, and where they differ first, if they do."""

    file: str
    ticks: int = 0
    identical: bool = True  # of the ticks that were computed
    complete: bool = True  # all ticks of the recording were; False also where it has none
    first_difference: dict[str, Any] | None = None  # tick, column, recorded, computed
    same_build: bool = True
    notes: list[str] = field(default_factory=list)

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


def replay(
    path: str | os.PathLike[str],
    out: str | os.PathLike[str] | None = None,
    progress: Callable[[float], None] | None = None,
) -> ReplayResult:
    """Computes every tick of a recording again from its inputs, and compares all columns bit for bit.

    A replay ends where ticks are missing: the state after them cannot be known. out: where the computed ticks go, a
    recording themselves. Raises RecordingError, ConfigurationError for an `out` that cannot be.
    """
    if out is not None:
        check_target(Path(path), Path(out), (".parquet",))
    recording = open_recording(path)
    result = ReplayResult(str(recording.path), notes=list(recording.notes))
    if recording.info.build != build_id():
        result.same_build = False
        result.notes.append(f"recorded by another build ({recording.info.build}) than this one ({build_id()})")
    again = _Again(recording, result)
    with ExitStack() as stack:
        output = None
        if out is not None:
            data = recording.info.data | {"replayed_from": str(recording.path), "replayed_by": build_id()}
            output = stack.enter_context(parquet_output(Path(out), recording.schema, data))
        for batch in recording.batches(progress):
            computed = again.run(batch)
            if output is not None and computed is not None:
                output.write(worded(computed, recording.schema))
            if not result.complete:
                break
    if recording.rows == 0:
        result.complete = False
        result.notes.append("the recording holds no tick: there is nothing to replay")
    if recording.damaged:
        result.complete = False
    if result.complete and recording.lost:
        result.notes.append(f"{recording.lost} ticks are missing at the end of the recording")
    return result


class _Again:
    """The servo step of a recording, and what it has to be compared with."""

    def __init__(self, recording: Recording, result: ReplayResult) -> None:
        info = recording.info
        self._path = recording.path
        self._result = result
        self._width = membranes_in(recording.schema)
        self._step = Replay(info.scene, info.gate, info.limits, info.spent)

    def run(self, batch: pa.RecordBatch) -> pa.RecordBatch | None:
        """Replays up to the first gap; None if there is nothing to replay."""
        n, why = self._knowable(batch)
        if n < len(batch):
            self._result.complete = False
            self._result.notes.append(why)
        batch = batch[:n]
        if n == 0:
            return None
        recorded = {f.name: numbers(batch, f.name) for f in batch.schema if f.name != NEW_SCENES}
        scenes = batch.column(NEW_SCENES).to_pylist()
        taken = recorded["commands"] & COMMAND_SCENE != 0
        computed = self._step.run(input_ticks(batch), [self._scenes(scenes[k]) for k in np.flatnonzero(taken)])
        self._compare(recorded, flatten(computed, self._width))
        self._result.ticks += n
        return raw_batch(computed, self._width, recorded[LOST].astype(np.uint32), scenes)

    def _scenes(self, texts: list[str]) -> list[Scene]:
        return [from_text(text, self._path) for text in texts]

    def _knowable(self, batch: pa.RecordBatch) -> tuple[int, str]:
        """How many ticks from the batch's beginning can be computed, and why not the next."""
        tick = numbers(batch, "tick").astype(np.int64)
        gaps = np.flatnonzero(tick != self._result.ticks + np.arange(len(tick)))
        n, why = len(tick), ""
        if len(gaps):
            n = int(gaps[0])
            missing = int(tick[n]) - self._result.ticks - n
            if self._result.ticks + n == 0:
                why = f"the recording begins at tick {tick[n]}; without what was before, nothing can be run again"
            else:
                why = f"{missing} ticks are missing before tick {tick[n]}; what comes after them cannot be run again"
        unknown = [
            k
            for k in np.flatnonzero(numbers(batch, "commands") & COMMAND_SCENE)
            if not batch.column(NEW_SCENES)[k].as_py()
        ]
        if unknown and unknown[0] < n:
            n = int(unknown[0])
            why = f"tick {tick[n]} took a scene that did not come through Recorder.exchange and is not in the recording"
        return n, why

    def _compare(self, recorded: Columns, computed: Columns) -> None:
        if not self._result.identical:
            return
        first: tuple[int, str] | None = None
        for name, column in computed.items():
            if name in recorded:
                differs = np.flatnonzero(_bits(column) != _bits(recorded[name].astype(column.dtype)))
                if len(differs) and (first is None or differs[0] < first[0]):
                    first = int(differs[0]), name
        if first is not None:
            k, name = first
            self._result.identical = False
            self._result.first_difference = {
                "tick": int(recorded["tick"][k]),
                "column": name,
                "recorded": recorded[name][k].item(),
                "computed": computed[name][k].item(),
            }


def _bits(column: NDArray[Any]) -> NDArray[Any]:
    """Numbers as bits: 0 and -0 differ, and one NaN is like another."""
    if column.dtype != np.float64:
        return column
    return np.where(np.isnan(column), np.float64(np.nan), column).view(np.uint64)

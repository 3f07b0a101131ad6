"""Replays a recording: through the same servo step, which must give the same forces, or as a device."""

from __future__ import annotations

import os
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypedDict

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from punctura._core import DeviceInfo, Replay, ReplayDevice, Scene
from punctura.progress import Report
from punctura.record.columns import (
    INPUTS,
    LOST,
    NEW_SCENES,
    input_ticks,
    membranes_in,
    numbers,
    raw_batch,
    worded,
)
from punctura.record.description import DeviceBefore, RecordingError
from punctura.record.header import build_id, from_text
from punctura.record.parquet_file import parquet_output
from punctura.record.recording import Recording, open_recording
from punctura.record.save_as import check_target
from punctura.ticks import ABSENT, COMMAND_SCENE, Columns, Ticks
from punctura.ticks.fields import flatten


class Difference(TypedDict):
    """A number of a recording, and the different number that its replay computed."""

    tick: int
    column: str
    recorded: float
    computed: float


@dataclass
class ReplayResult:
    """The number of replayed ticks, and the first difference if there is one."""

    file: str  # the recording
    ticks: int = 0  # computed again
    identical: bool = True  # whether all replayed ticks agree with the recording
    complete: bool = True  # whether all ticks were replayed; False for an empty recording
    first_difference: Difference | None = None  # None: there is none
    same_build: bool = True  # it was recorded by this build of Punctura
    notes: list[str] = field(default_factory=list)  # for the user


def replay(
    path: str | os.PathLike[str],
    out: str | os.PathLike[str] | None = None,
    progress: Report | None = None,
) -> ReplayResult:
    """Recomputes every tick of a recording from its inputs and compares all columns bit for bit.

    The replay stops at the first gap, because the state after missing ticks is unknown. out: file for the computed
    ticks, a recording too. Raises RecordingError, and ConfigurationError for an invalid `out`.
    """
    if out is not None:
        check_target(Path(path), Path(out), (".parquet",))
    recording = open_recording(path)
    result = ReplayResult(str(recording.path), notes=list(recording.notes))
    if recording.info.build != build_id():
        result.same_build = False
        result.notes.append(f"recorded by another build ({recording.info.build}) than this one ({build_id()})")
    again = _Replayer(recording, result)
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
        result.notes.append("the recording holds no ticks; nothing to replay")
    if recording.damaged:
        result.complete = False
    if result.complete and recording.lost:
        result.notes.append(f"{recording.lost} ticks are missing at the end of the recording")
    return result


class _Replayer:
    """Runs the servo step of a recording and compares the results."""

    def __init__(self, recording: Recording, result: ReplayResult) -> None:
        info = recording.info
        self._path = recording.path
        self._result = result
        self._width = membranes_in(recording.schema)
        self._step = Replay(info.scene, info.gate, info.limits, info.spent, rivals=info.rivals)

    def run(self, batch: pa.RecordBatch) -> pa.RecordBatch | None:
        """Replays up to the first gap; None if there is nothing to replay."""
        n, why = self._replayable(batch)
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
        if (computed.phase[:, self._width :] != ABSENT).any():
            raise RecordingError(f"{self._path}: columns were removed; its scene has more than {self._width} membranes")
        self._compare(recorded, flatten(computed, self._width))
        self._result.ticks += n
        return raw_batch(computed, self._width, recorded[LOST].astype(np.uint32), scenes)

    def _scenes(self, texts: list[str]) -> list[Scene]:
        return [from_text(text, self._path) for text in texts]

    def _replayable(self, batch: pa.RecordBatch) -> tuple[int, str]:
        """The number of ticks at the start of the batch that can be replayed, and the reason if more cannot."""
        tick = numbers(batch, "tick").astype(np.int64)
        gaps = np.flatnonzero(tick != self._result.ticks + np.arange(len(tick)))
        n, why = len(tick), ""
        if len(gaps):
            n = int(gaps[0])
            missing = int(tick[n]) - self._result.ticks - n
            if self._result.ticks + n == 0:
                why = f"the recording begins at tick {tick[n]}; a replay needs the ticks before it"
            else:
                why = f"{missing} ticks are missing before tick {tick[n]}; later ticks cannot be replayed"
        unknown = [
            k
            for k in np.flatnonzero(numbers(batch, "commands") & COMMAND_SCENE)
            if not batch.column(NEW_SCENES)[k].as_py()
        ]
        if unknown and unknown[0] < n:
            n = int(unknown[0])
            why = f"tick {tick[n]} took a scene that is not in the recording; change scenes through Recorder.exchange"
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
    """Numbers as bits: 0 and -0 differ, all NaNs are equal."""
    if column.dtype != np.float64:
        return column
    return np.where(np.isnan(column), np.float64(np.nan), column).view(np.uint64)


def replay_device(
    path: str | os.PathLike[str], real_time: bool = True, priority: int = 80, processor: int = -1
) -> ReplayDevice:
    """A device that plays every sample of a recording, finished or not, at the recorded rate.

    A loop with the recording's scene and limits, armed before its start, computes the recorded forces bit for bit.
    Commands to the recorded loop (another scene, a pause) are not repeated; `replay` repeats them.
    real_time: False runs as fast as possible. priority: real-time scheduling priority, 0 for none. processor: CPU
    number, -1 for any. Holds all samples in memory, 80 bytes each. Raises RecordingError.
    """
    recording = open_recording(path)
    samples = _samples(recording)
    try:
        rate, before = recording.info.header.rate_hz, recording.info.header.device
        device = ReplayDevice(
            samples.position,
            samples.axis,
            rate,
            time=samples.time,
            sequence=samples.sequence,
            buttons=samples.buttons,
            healthy=samples.healthy,
            motor_temperature=samples.motor_temperature,
            recorded=_info(before),
            real_time=real_time,
            priority=priority,
            processor=processor,
        )
        device.spent = recording.info.spent
        return device
    except (TypeError, ValueError) as bad:
        raise RecordingError(f"{recording.path}: its motion cannot be replayed as a device: {bad}") from None


def _info(before: DeviceBefore) -> DeviceInfo:
    return DeviceInfo(
        backend=before.backend,
        model=before.model,
        serial=before.serial,
        has_orientation=before.has_orientation,
        button_count=before.button_count,
        max_force=float(before.max_force),  # float(): an unknown number is the word "nan" in JSON
        continuous_force=float(before.continuous_force),
        max_stiffness=float(before.max_stiffness),
        encoder_step=float(before.encoder_step),
    )


def _samples(recording: Recording) -> Ticks:
    """All inputs, read batch by batch so that the other columns do not fill the memory."""
    parts = [input_ticks(batch) for batch in recording.batches()]
    if sum(map(len, parts)) == 0:
        raise RecordingError(f"{recording.path} holds no tick to replay")
    return Ticks({name: np.concatenate([part[name] for part in parts]) for name in INPUTS})

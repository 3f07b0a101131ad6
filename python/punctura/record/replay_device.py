"""A device that plays a recorded motion, for another scene or for a viewer."""

from __future__ import annotations

import os

import numpy as np

from punctura._core import DeviceInfo, ReplayDevice
from punctura.record.columns import INPUTS
from punctura.record.description import DeviceBefore
from punctura.record.errors import RecordingError
from punctura.record.recording import Recording, open_recording
from punctura.record.schema import input_ticks
from punctura.ticks import Ticks


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
        rate, said = recording.info.header.rate_hz, recording.info.header.device
        device = ReplayDevice(
            samples.position,
            samples.axis,
            rate,
            time=samples.time,
            sequence=samples.sequence,
            buttons=samples.buttons,
            healthy=samples.healthy,
            motor_temperature=samples.motor_temperature,
            recorded=_info(said),
            real_time=real_time,
            priority=priority,
            processor=processor,
        )
        device.spent = recording.info.spent
        return device
    except (TypeError, ValueError) as bad:
        raise RecordingError(f"{recording.path}: its motion cannot be replayed as a device: {bad}") from None


def _info(said: DeviceBefore) -> DeviceInfo:
    return DeviceInfo(
        backend=said.backend,
        model=said.model,
        serial=said.serial,
        has_orientation=said.has_orientation,
        button_count=said.button_count,
        max_force=float(said.max_force),  # float(): an unknown number is the word "nan" in JSON
        continuous_force=float(said.continuous_force),
        max_stiffness=float(said.max_stiffness),
        encoder_step=float(said.encoder_step),
    )


def _samples(recording: Recording) -> Ticks:
    """All inputs, read batch by batch so that the other columns do not fill the memory."""
    parts = [input_ticks(batch) for batch in recording.batches()]
    if sum(map(len, parts)) == 0:
        raise RecordingError(f"{recording.path} holds no tick to replay")
    return Ticks({name: np.concatenate([part[name] for part in parts]) for name in INPUTS})

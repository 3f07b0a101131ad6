"""A recorded motion as a device, for another scene or in front of a view."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from punctura._core import DeviceInfo, ReplayDevice
from punctura.record.columns import INPUTS
from punctura.record.errors import RecordingError
from punctura.record.recording import Recording, open_recording
from punctura.record.schema import input_ticks
from punctura.ticks import Ticks

# What a replay says of the device that was recorded. JSON has words where a number is not known.
_WORDS = ("backend", "model", "serial", "has_orientation", "button_count")
_NUMBERS = ("max_force", "continuous_force", "max_stiffness", "encoder_step")


def replay_device(
    path: str | os.PathLike[str], real_time: bool = True, priority: int = 80, processor: int = -1
) -> ReplayDevice:
    """Ticks what the device of a recording, finished or not, reported: every sample, at the recorded rate.

    In a loop with the recording's scene and limits, armed before its start, that gives the recorded forces to the last
    bit. What was asked of the recorded loop meanwhile (another scene, a pause) is not asked again: `replay` does that.
    real_time: False runs as fast as possible. priority: of real-time scheduling, 0 asks for none. processor: the one
    to tick on, -1 is any. Holds all samples in memory, 80 bytes each. Raises RecordingError.
    """
    recording = open_recording(path)
    samples = _samples(recording)
    try:
        rate, said = recording.info.said.rate_hz, recording.info.said.device
        about: dict[str, Any] = {name: getattr(said, name) for name in _WORDS}
        about |= {name: float(getattr(said, name)) for name in _NUMBERS}
        device = ReplayDevice(
            samples.position,
            samples.axis,
            rate,
            time=samples.time,
            sequence=samples.sequence,
            buttons=samples.buttons,
            healthy=samples.healthy,
            motor_temperature=samples.motor_temperature,
            recorded=DeviceInfo(**about),
            real_time=real_time,
            priority=priority,
            processor=processor,
        )
        device.spent = recording.info.spent
        return device
    except (TypeError, ValueError) as bad:
        raise RecordingError(f"{recording.path}: its motion cannot be played as a device: {bad}") from None


def _samples(recording: Recording) -> Ticks:
    """All inputs; batch by batch, so that the other columns are not in memory at once."""
    parts = [input_ticks(batch) for batch in recording.batches()]
    if sum(map(len, parts)) == 0:
        raise RecordingError(f"{recording.path} holds no tick to replay")
    return Ticks({name: np.concatenate([part[name] for part in parts]) for name in INPUTS})

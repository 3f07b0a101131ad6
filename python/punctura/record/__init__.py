# ruff: noqa: E402
"""Writes, reads and replays recordings of every tick (docs/recordings.md)."""

from punctura.extras import optional

optional("pyarrow", "files", "punctura.record")  # before the imports below would fail

from punctura.record.description import RecordingError
from punctura.record.finish import RecorderStatus
from punctura.record.recorder import Recorder
from punctura.record.recording import Recording, open_recording
from punctura.record.run_again import ReplayResult, replay, replay_device
from punctura.record.save_as import ExportResult, export

__all__ = [
    "ExportResult",
    "Recorder",
    "RecorderStatus",
    "Recording",
    "RecordingError",
    "ReplayResult",
    "export",
    "open_recording",
    "replay",
    "replay_device",
]

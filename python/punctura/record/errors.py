"""The exception for recordings."""

from __future__ import annotations

from punctura._core import PuncturaError
from punctura.errors import NoSuchFileError


class RecordingError(PuncturaError, ValueError):
    """A recording cannot be started, read or replayed. Names the file, the problem and the remedy."""


class MissingRecordingError(RecordingError, NoSuchFileError):
    """There is no file at a recording's path."""

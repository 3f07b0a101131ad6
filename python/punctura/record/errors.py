"""What goes wrong with recordings."""

from __future__ import annotations

from punctura._core import PuncturaError


class RecordingError(PuncturaError, ValueError):
    """A recording that cannot be begun, read or run again: which file, what is wrong, what to do."""

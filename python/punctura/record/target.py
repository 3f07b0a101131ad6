"""Checks the output path of an export or replay."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.record.errors import RecordingError
from punctura.record.recording import open_recording


def check_target(source: Path, target: Path, suffixes: Sequence[str]) -> None:
    """Raises ConfigurationError for an invalid path or an existing recording. Recordings are never overwritten."""
    problems = []
    if target.suffix.lower() not in suffixes:
        problems.append(f"must end in {' or '.join(suffixes)}")
    if target.is_dir():
        problems.append("is a folder")
    elif not target.parent.is_dir():
        problems.append(f"there is no folder {target.parent}")
    elif source.exists() and target.exists() and source.samefile(target):
        problems.append("is the recording itself")
    elif _is_recording(target):
        problems.append("is already a recording, which is never overwritten: delete it, or choose another name")
    if problems:
        raise ConfigurationError([Problem(f"out {target}", MISSING, problem) for problem in problems])


def _is_recording(file: Path) -> bool:
    if file.suffix.lower() != ".parquet" or not file.exists():
        return False
    try:
        open_recording(file)
    except RecordingError:
        return False
    return True

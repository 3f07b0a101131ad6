"""Checks the output path of an export or replay."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.target import same_file, target_problems
from punctura.record.errors import RecordingError
from punctura.record.recording import open_recording


def check_target(source: Path, target: Path, suffixes: Sequence[str]) -> None:
    """Raises ConfigurationError for an invalid path or an existing recording. Recordings are never overwritten."""
    problems = target_problems(target, suffixes)
    if same_file(source, target):
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

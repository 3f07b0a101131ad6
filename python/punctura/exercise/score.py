"""Scores a recording."""

from __future__ import annotations

import os
from datetime import datetime, timezone
from pathlib import Path

from punctura.errors import ConfigurationError, Problem
from punctura.exercise.attempt import Attempt
from punctura.exercise.exercise import Exercise
from punctura.exercise.load import load_exercise
from punctura.exercise.result import Result
from punctura.extras import optional


def score(recording: str | os.PathLike[str], exercise: Exercise | str, person: str = "") -> Result:
    """The result that the recorded attempt has in the studio. Raises RecordingError, ConfigurationError."""
    optional("pyarrow", "files", "the score of a recording")
    from punctura.events.finder import recorded_ticks
    from punctura.record import open_recording

    opened = open_recording(recording)
    wanted = load_exercise(exercise) if isinstance(exercise, str) else exercise
    try:
        attempt = Attempt(wanted, opened.info.scene, opened.info.header.second_device is not None)
    except ConfigurationError as bad:
        raise ConfigurationError([_with_remedy(p, wanted) for p in bad.problems], os.fspath(recording)) from None
    for columns, _ in recorded_ticks(opened):
        attempt.add(columns)
        if attempt.settled:
            break
    date = datetime.fromtimestamp(opened.info.began_ns / 1e9, timezone.utc)
    return attempt.finish(person, Path(recording).stem, date)


def _with_remedy(problem: Problem, exercise: Exercise) -> Problem:
    remedy = (
        f"choose a recording of the exercise {exercise.name} (its scene is {exercise.scene.name!r}), "
        "or the exercise that was recorded"
    )
    return problem._replace(reason=f"{problem.reason}; {remedy}")

"""Reads and checks exercise files, and scores recordings."""

import os
from datetime import datetime, timezone
from functools import cache
from pathlib import Path

from punctura import Scene
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.exercise.attempt import Attempt
from punctura.exercise.check import check_tables
from punctura.exercise.depths import tip_warnings
from punctura.exercise.exercise import Exercise
from punctura.exercise.result import Result
from punctura.extras import optional
from punctura.files.toml import Tables, decoded, parse_toml, read_tables
from punctura.scene import load_scene, scene_names

_FOLDER = Path(__file__).parents[1] / "ready_exercises"
SIMULATED = "simulated"  # the backend whose needle moves in its ticks only
_A_SCENE = "is a scene file, not an exercise file: an exercise has a [space] and [[goal]] tables, and names its scene"


def exercise_names() -> list[str]:
    """Names of the ready exercises, for load_exercise; the easiest first."""
    return list(_ready())


@cache
def _ready() -> tuple[str, ...]:
    levels = {file.stem: read_tables(file, "exercise").get("level", 100) for file in _FOLDER.glob("*.toml")}
    return tuple(sorted(levels, key=lambda name: (levels[name], name)))


def exercises() -> list[Exercise]:
    """The ready exercises."""
    return [load_exercise(name) for name in exercise_names()]


def load_exercise(name_or_path: str | os.PathLike[str]) -> Exercise:
    """Loads a ready exercise by its name, or a file. Raises ConfigurationError with all problems."""
    path = _path_of(name_or_path)
    tables = read_tables(path, "exercise", float)
    _refuse_scene(tables, str(path))
    scene, scene_name, scene_problems = _scene_of(tables.get("scene"), path)
    file, problems = check_tables(tables, scene)
    problems += scene_problems
    if problems or file is None or scene is None:
        raise ConfigurationError(problems, str(path))
    return Exercise(path.stem, path, file, scene, scene_name, tuple(tip_warnings(file, scene)))


def exercise_of(tables: Tables, name: str) -> Exercise:
    """An exercise from the tables of a file, with a ready scene. Raises ConfigurationError with all problems.

    It reads no file but that of the ready scene, so the tables may come from a page.
    """
    _refuse_scene(tables, name)
    given = tables.get("scene")
    scene = None
    problems: list[Problem] = []
    if isinstance(given, str) and given in scene_names():
        scene = load_scene(given)
    elif "scene" in tables:
        ready = ", ".join(scene_names())
        reason = f"must be one of the ready scenes: {ready}; with a scene file: run punctura run --exercise FILE"
        problems = [Problem("scene", given, reason)]
    file, more = check_tables(tables, scene)
    if problems or more or file is None or scene is None:
        raise ConfigurationError(problems + more, name)
    return Exercise(name, Path(f"{name}.toml"), file, scene, str(given), tuple(tip_warnings(file, scene)))


def exercise_of_bytes(data: bytes, name: str) -> Exercise:
    """An exercise from the bytes of a file, with a ready scene. See exercise_of."""
    path = Path(f"{name}.toml")
    return exercise_of(parse_toml(decoded(data, path), path, float), name)


def _refuse_scene(tables: Tables, source: str) -> None:
    """One sentence in place of a problem for each table of a scene."""
    if {"needle", "membrane"} & tables.keys() and not {"start", "space", "goal"} & tables.keys():
        raise ConfigurationError([Problem("", MISSING, _A_SCENE)], source)


def _path_of(name_or_path: str | os.PathLike[str]) -> Path:
    path = Path(name_or_path)
    if isinstance(name_or_path, str) and not path.suffix and path.name == name_or_path:
        if name_or_path in exercise_names():
            return _FOLDER / f"{name_or_path}.toml"
        known = ", ".join(exercise_names())
        reason = f"there is no ready exercise of this name; ready exercises: {known}"
        raise ConfigurationError([Problem("", MISSING, reason)], name_or_path)
    return path


def _scene_of(given: object, path: Path) -> tuple[Scene | None, str, list[Problem]]:
    if not isinstance(given, str) or not given:
        return None, "", []
    name = given if given in scene_names() else str(path.parent / given)
    try:
        return load_scene(name), name, []
    except ConfigurationError as bad:
        return None, name, [Problem("scene", given, "; ".join(str(p) for p in bad.problems))]


def score(recording: str | os.PathLike[str], exercise: Exercise | str, person: str = "") -> Result:
    """The result that the recorded attempt has in the studio. Raises RecordingError, ConfigurationError."""
    optional("pyarrow", "files", "the score of a recording")
    from punctura.events.finder import recorded_ticks
    from punctura.record import RecordingError, open_recording

    opened = open_recording(recording)
    if opened.info.rivals:
        names = " and ".join(rival.name for rival in opened.info.rivals)
        reason = "an exercise judges pops and forces of the scene's law; record an attempt without --rival"
        raise RecordingError(f"{opened.path}: the force is that of {names}: {reason}")
    wanted = load_exercise(exercise) if isinstance(exercise, str) else exercise
    try:
        header = opened.info.header
        simulated = header.device.backend == SIMULATED
        attempt = Attempt(wanted, opened.info.scene, header.second_device is not None, simulated)
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

"""A scene and the tables of its file: the page's editor shows the tables, the loop runs the scene."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from punctura import Scene
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.toml import Tables, parse_toml, read_text
from punctura.scene import scene_path
from punctura.scene.build import build_scene, file_text
from punctura.scene.check import check_tables, unusual_numbers
from punctura.scene.schema import SceneFile
from punctura.studio.wire.common import ProblemPart

# The schema finds wrong types; these are the limits of Python's own types.
_TOO_MUCH = (RecursionError, OverflowError)


@dataclass(frozen=True)
class Loaded:
    """A scene file without errors, and its scene in SI."""

    file: SceneFile
    scene: Scene
    unusual: tuple[str, ...] = ()  # numbers that are probably in another unit, each with its remedy

    def tables(self) -> Tables:
        """The tables as JSON values, under the file's keys, with defaults filled in."""
        return self.file.model_dump(mode="json", exclude_none=True)

    def text(self) -> str:
        """The text of a scene file."""
        return file_text(self.file)


def from_tables(tables: Tables, source: str = "", text: str = "") -> Loaded:
    """text: that of the file, if there is one. Raises ConfigurationError with every problem, in the file's own keys."""
    try:
        file, problems = check_tables(tables)
    except _TOO_MUCH:
        raise ConfigurationError([Problem("", MISSING, "is no scene: it is nested too deeply")], source) from None
    if file is None:
        raise ConfigurationError(problems, source)
    return Loaded(file, build_scene(file), unusual_numbers(file, text, source))


def from_text(text: str, source: str = "the file") -> Loaded:
    """From a scene file's text. Raises ConfigurationError."""
    try:
        tables = parse_toml(text, Path(source))
    except _TOO_MUCH:
        raise ConfigurationError([Problem("", MISSING, "is no scene: it is nested too deeply")], source) from None
    return from_tables(tables, source, text)


def from_name(path_or_name: str) -> Loaded:
    """A ready scene or a file, as load_scene takes them. Raises ConfigurationError."""
    path = scene_path(path_or_name)
    return from_text(read_text(path, "scene"), str(path))


def problem_parts(problems: Sequence[Problem]) -> list[ProblemPart]:
    """The problems, for the page."""
    return [
        ProblemPart(path=p.path, value="" if p.value is MISSING else repr(p.value)[:200], reason=p.reason)
        for p in problems
    ]

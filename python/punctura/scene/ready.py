"""The ready scenes of the package."""

import os
import warnings
from pathlib import Path

from punctura._core import Scene
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.toml import parse_toml, read_text
from punctura.scene.build import build_scene
from punctura.scene.check import UnusualWarning, check_tables, unusual_numbers

_FOLDER = Path(__file__).parents[1] / "ready_scenes"


def scene_names() -> list[str]:
    """Names of the ready scenes, for load_scene."""
    return sorted(file.stem for file in _FOLDER.glob("*.toml"))


def scene_path(path_or_name: str | os.PathLike[str]) -> Path:
    """The file of the ready scene `path_or_name`, or else `path_or_name` as a path."""
    if not isinstance(path_or_name, (str, os.PathLike)):
        raise TypeError(f"a scene is a file or the name of a ready scene, not {type(path_or_name).__name__}")
    if isinstance(path_or_name, str) and path_or_name in scene_names():
        return _FOLDER / f"{path_or_name}.toml"
    path = Path(path_or_name)
    if isinstance(path_or_name, str) and not path.suffix and path.name == path_or_name and not path.exists():
        known = ", ".join(scene_names())
        raise ConfigurationError(
            [Problem("", MISSING, f"no file and no ready scene has this name; ready scenes: {known}")],
            path_or_name,
        )
    return path


def load_scene(path_or_name: str | os.PathLike[str]) -> Scene:
    """Loads a scene from a file, or a ready scene by its name. Raises ConfigurationError with all problems.

    Warns of numbers that are off by a factor of 1,000 and so probably in another unit, with their lines.
    """
    path = scene_path(path_or_name)
    text = read_text(path, "scene")
    scene_file, problems = check_tables(parse_toml(text, path))
    if scene_file is None:
        raise ConfigurationError(problems, str(path))
    for sentence in unusual_numbers(scene_file, text, str(path)):
        warnings.warn(sentence, UnusualWarning, stacklevel=2)
    return build_scene(scene_file)

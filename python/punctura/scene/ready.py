"""The ready scenes of the package."""

from __future__ import annotations

import os
from pathlib import Path

from punctura._core import Scene
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.toml import read_tables
from punctura.scene.build import build_scene
from punctura.scene.check import check_tables

_FOLDER = Path(__file__).parents[1] / "scenes"


def scene_names() -> list[str]:
    """Names of the ready scenes, for load_scene."""
    return sorted(file.stem for file in _FOLDER.glob("*.toml"))


def scene_path(path_or_name: str | os.PathLike[str]) -> Path:
    """The file of the ready scene `path_or_name`, or else `path_or_name` as a path."""
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
    """Loads a scene from a file, or a ready scene by its name. Raises ConfigurationError with all problems."""
    path = scene_path(path_or_name)
    scene_file, problems = check_tables(read_tables(path, "scene"))
    if scene_file is None:
        raise ConfigurationError(problems, str(path))
    return build_scene(scene_file)

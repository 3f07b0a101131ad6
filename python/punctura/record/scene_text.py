"""A scene in a recording: the text of its file, exact to the last bit."""

from __future__ import annotations

from pathlib import Path

from punctura._core import Scene
from punctura.errors import ConfigurationError
from punctura.files.toml import parse_toml
from punctura.record.errors import RecordingError
from punctura.scene import scene_text
from punctura.scene.build import build_scene
from punctura.scene.check import check_tables


def to_text(scene: Scene, rate: float) -> str:
    """The scene as it runs: at the device's rate (Hz)."""
    return scene_text(scene.replace(servo=scene.servo.replace(rate=rate)))


def from_text(text: str, path: Path) -> Scene:
    """The same scene again. Raises RecordingError."""
    try:
        scene_file, problems = check_tables(parse_toml(text, path))
        if scene_file is None:
            raise ConfigurationError(problems, str(path))
        return build_scene(scene_file)
    except ConfigurationError as bad:
        raise RecordingError(f"{path}: a scene in the recording cannot be used: {bad}") from None

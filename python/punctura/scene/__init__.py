"""Reads, checks and writes scene files; holds the ready scenes of the package (docs/scene-file.md)."""

from punctura._core import DisplaySettings, SceneField, ServoSettings
from punctura.scene.json_schema import scene_json_schema
from punctura.scene.ready import load_scene, scene_names, scene_path
from punctura.scene.write import save_scene, scene_text

__all__ = [
    "DisplaySettings",
    "SceneField",
    "ServoSettings",
    "load_scene",
    "save_scene",
    "scene_json_schema",
    "scene_names",
    "scene_path",
    "scene_text",
]

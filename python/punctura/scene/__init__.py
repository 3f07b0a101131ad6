"""Reads, checks and writes scene files; holds the ready scenes of the package (docs/scene-file.md)."""

from punctura._core import DisplaySettings, SceneField, ServoSettings
from punctura.scene.build import save_scene, scene_text
from punctura.scene.ready import load_scene, scene_names, scene_path
from punctura.scene.schema import scene_json_schema

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

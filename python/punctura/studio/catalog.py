"""What there is to choose from."""

from __future__ import annotations

from functools import cache

from punctura.scene import load_scene, scene_names
from punctura.studio.wire.messages import Choice


@cache
def _ready_scenes() -> tuple[Choice, ...]:
    return tuple(Choice(name=name, title=load_scene(name).name) for name in scene_names())


def ready_scenes() -> list[Choice]:
    """The scenes that come with the package."""
    return list(_ready_scenes())

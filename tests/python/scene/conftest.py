"""A valid scene file for tests that change it."""

from collections.abc import Callable
from pathlib import Path

import pytest

SOUND = """
name = "test"

[needle]
diameter_mm = 1.08
tip_angle_rad = 0.28

[coupling]
stiffness_N_per_mm = 0.4
damping_Ns_per_mm = 0.001

[[membrane]]
name = "skin"
stiffness_N_per_mm = 0.57
precompression_N = 0.41
friction = 0.2
thickness_mm = 1.0
point_mm = [0, 0, 0]
inward_normal = [0, -1, 0]

[[membrane]]
name = "wall"
stiffness_N_per_mm = 0.57
precompression_N = 0.41
friction = 0.2
thickness_mm = 0.5
point_mm = [0, -4, 0]
inward_normal = [0, -2, 0]
"""


@pytest.fixture
def sound_text() -> str:
    return SOUND


Write = Callable[..., Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Writes the valid scene with some text replaced: write(("friction = 0.2", "friction = 3.6"), ...)."""

    def write_scene(*changes: tuple[str, str], text: str = SOUND) -> Path:
        for old, new in changes:
            assert old in text
            text = text.replace(old, new, 1)
        path = tmp_path / "scene.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write_scene

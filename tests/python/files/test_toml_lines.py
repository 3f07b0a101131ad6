"""The lines of keys in a TOML text."""

import pytest
from punctura import scene_names
from punctura.files.toml import key_lines
from punctura.scene.ready import scene_path

TEXT = '''# a comment with [brackets] = 1
name = 'a = b'

[needle]  # its head
diameter_mm = 1.08
"tip angle" = [
  1,  # one
  2,
]
long = """
not = a key
"""
coupling.stiffness = {a = 1, b = [2]}
[[membrane]]
friction = 0.2
[[membrane]]
friction = 0.3
[membrane.tissue]
grip = 1
'''


def test_each_key_has_its_line():
    assert key_lines(TEXT) == {
        ("name",): 2,
        ("needle",): 4,
        ("needle", "diameter_mm"): 5,
        ("needle", "tip angle"): 6,
        ("needle", "long"): 10,
        ("needle", "coupling", "stiffness"): 13,
        ("membrane", 0): 14,
        ("membrane", 0, "friction"): 15,
        ("membrane", 1): 16,
        ("membrane", 1, "friction"): 17,
        ("membrane", 1, "tissue"): 18,
        ("membrane", 1, "tissue", "grip"): 19,
    }


@pytest.mark.parametrize("name", scene_names())
def test_in_the_ready_scenes_each_line_holds_its_key(name):
    text = scene_path(name).read_text()
    lines = key_lines(text)
    assert len(lines) > 10
    for place, line in lines.items():
        key = next(part for part in reversed(place) if isinstance(part, str))
        assert key in text.splitlines()[line - 1]

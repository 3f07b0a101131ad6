"""`[display] force_scale` in a scene file."""

import pytest
from punctura import ConfigurationError, load_scene, save_scene
from punctura._core import ForceLimits, force_scale
from punctura.scene import DisplaySettings, scene_json_schema, scene_text
from punctura.studio.loaded import from_text

LAST = "inward_normal = [0, -2, 0]\n"


def display(value):
    return LAST, f"{LAST}\n[display]\nforce_scale = {value}\n"


def test_without_the_table_the_device_gives_the_whole_force_and_the_text_has_no_table(write):
    scene = load_scene(write())
    assert scene.display == DisplaySettings() and scene.display.force_scale == 1
    assert "display" not in scene_text(scene)
    assert force_scale(scene, ForceLimits()) == 1


@pytest.mark.parametrize("value", ["0.3", '"automatic"', "1"])
def test_a_scale_is_read_written_and_read_again(write, tmp_path, value):
    scene = load_scene(write(display(value)))
    assert scene.display.force_scale == ("automatic" if "auto" in value else float(value))
    save_scene(scene, tmp_path / "again.toml")
    assert load_scene(tmp_path / "again.toml") == scene
    assert from_text(from_text((tmp_path / "again.toml").read_text()).text()).scene == scene


@pytest.mark.parametrize(
    ("value", "reason"),
    [
        ("0", "must be greater than 0 and at most 1"),
        ("1.5", "must be greater than 0 and at most 1"),
        ('"auto"', 'must be a number or "automatic"'),
        ("true", 'must be a number or "automatic"'),
    ],
)
def test_another_value_is_refused_at_its_key(write, value, reason):
    with pytest.raises(ConfigurationError) as error:
        load_scene(write(display(value)))
    (problem,) = error.value.problems
    assert problem.path == "display.force_scale" and problem.reason.startswith(reason)


def test_the_schema_knows_number_and_word():
    schema = scene_json_schema()["$defs"]["DisplayTable"]["properties"]["force_scale"]
    assert schema["anyOf"] == [{"type": "number", "exclusiveMinimum": 0, "maximum": 1}, {"const": "automatic"}]
    assert schema["default"] == 1 and schema["x-reason"].startswith("must be greater than 0")


def test_the_scale_is_a_number_of_the_scene_unless_it_is_automatic():
    scene = load_scene("k06-fig10")
    assert "display.force_scale" in [field.path for field in scene.fields()]
    assert scene.with_values({"display.force_scale": 0.5}).display == DisplaySettings(0.5)
    automatic = scene.replace(display=DisplaySettings("automatic"))
    assert "display.force_scale" not in [field.path for field in automatic.fields()]
    with pytest.raises(ConfigurationError):
        scene.with_values({"display.force_scale": 2})

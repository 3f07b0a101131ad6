"""All numbers of a scene by path: fields() lists them with unit and bounds, with_values() changes and checks them."""

import math
import pickle

import numpy as np
import pytest
from punctura import ConfigurationError, load_scene, scene_names


def test_every_number_of_a_scene_is_listed_with_its_unit_and_bounds():
    scene = load_scene("venipuncture")
    fields = {field.path: field for field in scene.fields()}
    assert len(fields) == len(scene.fields()) == 2 + 2 + 4 + 1 + 16 * len(scene.membranes)
    friction = fields["membrane[1].friction"]
    assert (friction.value, friction.unit, friction.symbol) == (scene.membranes[1].membrane.friction, "-", "mu")
    assert (friction.min, friction.max, friction.min_open, friction.max_open) == (0, math.inf, True, True)
    assert fields["membrane[2].point[1]"].value == scene.membranes[2].point[1]
    assert fields["servo.rate"].unit == "Hz" and (fields["servo.rate"].min, fields["servo.rate"].max) == (100, 1e5)
    assert repr(friction).startswith("SceneField(path='membrane[1].friction', value=")
    assert "greater than 0" in friction.reason
    assert pickle.loads(pickle.dumps(scene.fields())) == scene.fields()


@pytest.mark.parametrize("name", scene_names())
def test_its_own_values_give_the_same_scene(name):
    scene = load_scene(name)
    assert scene.with_values({field.path: field.value for field in scene.fields()}) == scene


def test_one_changed_value_changes_that_field_alone():
    scene = load_scene("k06-fig12")
    for field in scene.fields():
        value = {
            "servo.encoder_step": 1e-5,
            "servo.sub_steps": 2,
            "display.force_scale": 0.5,
            "membrane[0].tail_floor": 0.5,
            "membrane[1].tail_floor": 0.5,
        }.get(field.path, field.value + 1e-4)
        changed = scene.with_values({field.path: np.float64(value)})
        before, after = scene.fields(), changed.fields()
        assert [b.path for b, a in zip(before, after, strict=True) if b.value != a.value] == [field.path]
    assert scene == load_scene("k06-fig12")


def test_a_path_that_is_none_and_a_value_that_cannot_be_are_told_together():
    scene = load_scene("k06-fig10")
    with pytest.raises(ConfigurationError) as raised:
        scene.with_values({"membrane[0].frictoin": 0.3, "membrane[0].thickness": -1.0, "membrane[9].friction": 0.2})
    text = str(raised.value)
    assert "did you mean membrane[0].friction?" in text
    assert "membrane[9].friction" in text and "membrane[0].thickness" in text
    for no_number in ("0.3", True, None, [0.3]):
        with pytest.raises(TypeError, match=r"membrane\[0\].friction must be a number"):
            scene.with_values({"membrane[0].friction": no_number})
    with pytest.raises(ConfigurationError, match="is not a number of this scene"):
        scene.with_values({"membran\ud800": 1.0})
    with pytest.raises(TypeError, match=r"servo.solver is not a number.*; replace\(\) sets words"):
        scene.with_values({"servo.solver": "paper"})
    with pytest.raises(TypeError, match="paths must be str"):
        scene.with_values({0: 0.3})
    with pytest.raises(ConfigurationError, match="finite"):
        scene.with_values({"membrane[0].friction": math.nan})


def test_a_value_in_another_unit_gives_a_warning_that_names_the_path():
    with pytest.warns(UserWarning, match=r"membrane\[0\].stiffness = 0.57 N/m is unusual.*N/mm"):
        load_scene("k06-fig10").with_values({"membrane[0].stiffness": 0.57})


def test_a_number_that_changes_the_dict_or_fails_is_told_as_it_is():
    scene = load_scene("k06-fig10")

    class Clears:
        def __float__(self):
            values.clear()
            return 0.3

    values = {"membrane[0].friction": Clears(), "membrane[0].thickness": 2e-3}
    changed = scene.with_values(values)
    assert (changed.membranes[0].membrane.friction, changed.membranes[0].membrane.thickness) == (0.3, 2e-3)

    class Interrupted:
        def __float__(self):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        scene.with_values({"membrane[0].friction": Interrupted()})

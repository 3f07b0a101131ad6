"""`look` and `behind`: the kinds of tissue in the studio's picture."""

from typing import get_args

import punctura as pn
import pytest
from punctura.scene import scene_json_schema, scene_text
from punctura.scene.schema import Behind, Look
from punctura.studio.loaded import from_name, from_tables, from_text
from punctura.studio.view import scene_view


def membrane(**words):
    return pn.PlacedMembrane("one", pn.Membrane(500, 0.4, 0.2, 1e-3), [0, 0, 0], [0, -1, 0], **words)


@pytest.mark.parametrize(("key", "words"), [("look", get_args(Look)), ("behind", get_args(Behind))])
def test_the_schema_and_the_core_have_the_same_words(key, words):
    for word in words:
        assert getattr(membrane(**{key: word}), key) == word
    with pytest.raises(pn.ConfigurationError) as error:
        membrane(**{key: "glass"})
    assert error.value.problems[0].path == f"membrane.{key}"
    assert error.value.problems[0].reason == "must be one of " + ", ".join(f'"{word}"' for word in words)
    entry = scene_json_schema()["$defs"]["MembraneTable"]["properties"][key]
    assert entry["enum"] == list(words) and entry["default"] == words[0] and entry["description"]


def test_a_scene_keeps_its_looks_in_files_recordings_and_copies():
    scene = pn.load_scene("epidural")
    assert [placed.look for placed in scene.membranes] == [
        "skin", "fat", "ligament", "ligament", "ligamentum flavum", "dura"]  # fmt: skip
    assert [placed.behind for placed in scene.membranes][-2:] == ["epidural space", "cerebrospinal fluid"]
    assert from_text(scene_text(scene)).scene == scene
    assert scene.with_values({"membrane[0].friction": 0.1}).membranes[0].look == "skin"


def test_the_page_gets_the_looks_and_k06_stays_plain():
    view = scene_view(from_name("venipuncture"), 0, 1600.0, 1.0)
    assert [(m.look, m.behind) for m in view.membranes] == [
        ("skin", "fat"), ("vein wall", "blood"), ("vein wall", "muscle")]  # fmt: skip
    for name in ("k06-fig10", "k06-fig11", "k06-fig12"):
        assert {placed.look for placed in pn.load_scene(name).membranes} == {"plain"}


def test_a_wrong_look_is_reported_at_its_key_beside_other_problems():
    tables = from_name("k06-fig12").tables()
    tables["membrane"][1] |= {"look": "glass", "friction": -1}
    with pytest.raises(pn.ConfigurationError) as error:
        from_tables(tables)
    problems = {p.path: p.reason for p in error.value.problems}
    assert set(problems) == {"membrane[1].look", "membrane[1].friction"}
    assert "'plain', 'skin', 'fat'" in problems["membrane[1].look"]


def test_the_look_changes_no_force():
    scene = pn.load_scene("venipuncture")
    plain = scene.replace(membranes=[placed.replace(look="plain") for placed in scene.membranes])
    forces = []
    for each in (scene, plain):
        insertion = pn.Insertion(each)
        forces.append([insertion.step([0, -y * 1e-5, 0], [0, -1, 0]) for y in range(-100, 900)])
    assert repr(forces[0]) == repr(forces[1])

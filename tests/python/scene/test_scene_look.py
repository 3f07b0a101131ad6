"""`look` and `behind`: the kinds of tissue in the studio's picture, and the lumen."""

from typing import get_args

import punctura as pn
import pytest
from punctura.scene import scene_json_schema, scene_text
from punctura.scene.build import file_text
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


def tables(*behind):
    """Membranes 2 mm apart, in reverse order in the file."""
    scene = from_name("k06-fig12").tables()
    one = scene["membrane"][0]
    scene["membrane"] = [
        {**one, "name": str(i), "point_mm": [0, -2.0 * (len(behind) - i), 0], "behind": what}
        for i, what in enumerate(behind)
    ]
    return scene


def test_the_lumen_is_between_the_membrane_that_says_so_and_the_next_in_the_way():
    assert from_name("venipuncture").scene.lumen == (1, 2)
    assert from_name("k06-fig12").scene.lumen is None
    assert from_tables(tables("tissue", "blood", "tissue")).scene.lumen == (1, 0)


@pytest.mark.parametrize(
    ("behind", "problems"),
    [
        (("blood", "tissue"), [("membrane[0].behind", "no other membrane")]),
        (("tissue", "blood", "blood"), [("membrane[2].behind", "only one membrane")]),
        (("tissue", "wine"), [("membrane[1].behind", "'tissue', 'blood', 'fat'")]),
        (("tissue", 1), [("membrane[1].behind", "'tissue', 'blood', 'fat'")]),
    ],
)
def test_blood_that_is_not_bounded_or_is_twice_is_a_problem(behind, problems):
    with pytest.raises(pn.ConfigurationError) as error:
        from_tables(tables(*behind))
    assert [p.path for p in error.value.problems] == [path for path, _ in problems]
    assert all(reason in p.reason for p, (_, reason) in zip(error.value.problems, problems, strict=True))


def test_it_is_told_beside_other_problems_and_never_in_their_way():
    wrong = tables("blood", "tissue")
    wrong["membrane"][1]["point_mm"] = "here"
    wrong["membrane"][0]["friction"] = -1
    with pytest.raises(pn.ConfigurationError) as error:
        from_tables(wrong)
    assert {"membrane[0].friction", "membrane[1].point_mm"} == {p.path for p in error.value.problems}


def test_a_form_can_offer_it():
    entry = scene_json_schema()["$defs"]["MembraneTable"]["properties"]["behind"]
    assert entry["enum"][:2] == ["tissue", "blood"] and entry["default"] == "tissue" and entry["description"]


@pytest.mark.parametrize("name", pn.scene_names())
def test_a_file_s_text_has_every_value_as_it_was_given(name):
    loaded = from_name(name)
    again = from_text(file_text(loaded.file))
    assert again.file == loaded.file and again.scene == loaded.scene
    assert from_tables(loaded.tables()).scene == loaded.scene


def test_a_view_is_of_unit_normals_and_plain_numbers():
    loaded = from_tables({**tables("tissue", "blood"), "membrane": [
        {**m, "inward_normal": [0, -3, 0]} for m in tables("tissue", "tissue")["membrane"]]})  # fmt: skip
    view = scene_view(loaded, 2, 1000.0, 1.0)
    assert view.membranes[0].inward_normal == [0.0, -1.0, 0.0] and view.number == 2 and view.rate == 1000.0
    assert "NaN" not in view.model_dump_json()

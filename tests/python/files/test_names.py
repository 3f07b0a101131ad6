"""A file's name as text is fit for a terminal, a report and the name of a scene."""

import punctura as pn
from punctura.files.names import as_text


def test_what_no_scene_may_have_as_its_name_is_replaced():
    wall = pn.load_scene("k06-fig10").membranes
    name = as_text(b"a\x1b[31m\nb\xff\xc2\x9b \xc3\xa9.csv")
    assert name == "a?[31m?b\ufffd? \u00e9.csv"
    pn.Insertion(pn.Scene(name, pn.Needle(1e-3, 0.3), pn.Coupling(400, 1), wall))

"""Names as long as a file may have them leave the page as it is."""

import re

import pytest
from person import drag_in, ready, tab
from playwright.sync_api import expect
from punctura.exercise import load_exercise
from punctura.scene import scene_path
from studio_process import StudioProcess

LONG, WORDS = "Longword" * 25, ("a name of many words " * 10)[:200]


@pytest.fixture
def studio(tmp_path):
    exercise = load_exercise("stop-after-pop")
    scene = re.sub('name = ".*"', f'name = "{LONG}"', scene_path("k06-fig10").read_text())
    (tmp_path / "long.toml").write_text(scene)
    file = tmp_path / "own.toml"
    text = exercise.path.read_text().replace("k06-fig10", "long.toml").replace("the place behind the membrane", WORDS)
    file.write_text(text.replace("Stop after the pop", LONG).replace("thin membrane", LONG))
    with StudioProcess(tmp_path, str(tmp_path / "long.toml"), more=["--exercise", str(file)]) as running:
        yield running


def test_a_name_of_200_characters_is_cut_and_shown_whole_on_hover(page):
    ready(page)
    drag_in(page, 1)
    for name in ("Hand", "Scene", "Recordings", "Exercises", "Lab", "Health"):
        page.set_viewport_size({"width": 1440, "height": 900})
        side = tab(page, name)
        if name == "Exercises":
            card = side.locator("article.exercise h3").first
            expect(card).to_have_attribute("title", LONG)
            inside(page, card)
        page.set_viewport_size({"width": 390, "height": 844})
        assert page.evaluate("document.documentElement.scrollWidth") <= 390, name
    for place in (".membrane-name", ".event-name"):
        expect(page.locator(place).first).to_have_attribute("title", LONG)
        inside(page, page.locator(place).first)


def inside(page, part):
    """It has at most two lines, and no wider part."""
    height, line, over = part.evaluate(
        "e => [e.clientHeight, parseFloat(getComputedStyle(e).fontSize) * 2, e.scrollWidth - e.clientWidth]"
    )
    assert 0 < height <= 2 * line and over <= 1

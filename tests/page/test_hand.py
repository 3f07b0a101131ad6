"""The simulated hand, when a run ends under the mouse and when the page is loaded anew."""

import pytest
from person import own_exercise, ready, tab, view
from playwright.sync_api import expect
from punctura.studio.client import StudioClient
from studio_process import StudioProcess

TITLE = "Three seconds"


@pytest.fixture
def studio(tmp_path):
    """A studio that lists an exercise of three seconds after the first contact."""
    file = own_exercise(tmp_path, TITLE, ("seconds = 60", "seconds = 3"))
    with StudioProcess(tmp_path, "k06-fig10", more=["--exercise", str(file)]) as running:
        yield running


def begin(page):
    ready(page)
    tab(page, "Exercises")
    card = page.locator("article.exercise", has_text=TITLE)
    card.get_by_role("button", name="Start").click()
    expect(page.locator(".running")).to_be_visible()
    expect(page.locator(".header")).to_contain_text("Force on")


def test_a_drag_that_is_held_over_the_end_of_an_attempt_does_not_move_the_next_needle(page, studio):
    begin(page)
    with StudioClient(studio.url, keep_frames=True) as looks_on:
        looks_on.wait(lambda: looks_on.last)
        run = looks_on.run
        box = view(page).bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + 0.2 * box["height"]
        page.mouse.move(x, y)
        page.mouse.down()
        for k in range(3000):  # down into the tissue, and then to and fro until the time is over
            y += 4 if k < 150 else 1 if k % 2 else -1
            page.mouse.move(x, y)
            page.wait_for_timeout(20)
            if page.get_by_role("dialog").count() and looks_on.run > run:
                break
        assert looks_on.run == run + 1, "the attempt did not end"
        assert any(e["what"] == "touch" for e in looks_on.of("event"))
        seen = len(looks_on.of("event"))
        looks_on.wait(lambda n=looks_on.ticks: looks_on.ticks > n + 1600)
        page.mouse.up()
        tips = [tip for f in looks_on.frames if f.run == run + 1 for tip in f.ticks["tip"][:, 1]]
        assert len(tips) > 1600 and min(tips) > 4e-3, "the needle of the next run has moved"
        assert looks_on.of("event")[seen:] == []


def test_a_page_that_is_loaded_anew_shows_the_angle_of_the_needle(page):
    begin(page)
    tab(page, "Hand")
    angle = page.locator("output[for='hand-angle']")
    expect(angle).to_have_text("60 degrees")
    page.reload()
    expect(page.locator(".connection-words")).to_have_text("Connected")
    tab(page, "Hand")
    expect(angle).to_have_text("60 degrees")

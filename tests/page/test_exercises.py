"""Exercises from the user, passed and failed: venipuncture and blind, at any speed of the computer."""

import json

import numpy as np
import pytest
from person import events, own_exercise, push, ready, saved, still_picture, tab, view, whole_at
from playwright.sync_api import expect
from studio_process import StudioProcess

TITLE = "In your own time"


@pytest.fixture
def studio(tmp_path, request):
    """A studio that lists an exercise without a time limit. request.param: which one, and changes of its text."""
    of, *changes = request.param
    file = own_exercise(tmp_path, TITLE, ('[[goal]]\nkind = "time_limit"\nseconds = 60', ""), *changes, of=of)
    with StudioProcess(tmp_path, "k06-fig10", more=["--exercise", str(file)]) as running:
        yield running


def begin(page):
    ready(page)
    tab(page, "Exercises")
    page.get_by_role("textbox", name="Your name").fill("Ann")
    page.get_by_role("textbox", name="Class").fill("3b")
    card = page.locator("article.exercise", has_text=TITLE)
    card.get_by_role("button", name="Start").click()
    expect(page.locator(".running")).to_be_visible()
    expect(page.locator(".header")).to_contain_text("Force on")


# A slow computer must not pass it on the way.
@pytest.mark.parametrize("studio", [("venipuncture", ("seconds = 3", "seconds = 600"))], indirect=True)
def test_going_through_the_back_wall_is_told_and_drawn_from_a_small_trace(page):
    fetched = []
    page.on("response", lambda answer: fetched.append(answer) if "/api/recordings/" in answer.url else None)
    begin(page)
    task = page.locator(".running")
    for size in ((1440, 900), (1024, 768), (390, 844)):
        whole_at(page, size, task.locator(".instruction"), task.get_by_role("button", name="End"))
        if size != (390, 844):  # a phone has room for the instruction only
            whole_at(page, size, *task.locator(".goals li").all())
    page.set_viewport_size({"width": 1440, "height": 900})
    for _ in range(60):
        push(page, "Shift+ArrowDown", 5)
        if page.get_by_role("dialog").count():
            break
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("not passed")
    expect(dialog).to_contain_text("You went through the back vein wall")
    expect(dialog.locator(".coach.change")).to_contain_text("You still moved in at ")
    expect(dialog).to_contain_text("Peak model force")
    expect(dialog.locator(".trace svg")).to_contain_text("model force (N)")
    expect(dialog.locator(".trace svg")).to_contain_text("✕ missed")
    assert len(fetched) == 1 and "/trace?" in fetched[0].url and len(fetched[0].body()) < 100_000


@pytest.mark.parametrize("studio", [("venipuncture",)], indirect=True)
def test_staying_in_the_vein_passes_and_the_next_attempt_is_shown_beside_it(page, tmp_path):
    begin(page)
    running = page.locator(".running")
    expect(page.locator(".view-label.goal")).to_have_text("Goal: the vein")
    push(page, "Shift+ArrowDown", 17)  # the skin is 10 mm away, the vein 20
    for _ in range(200):
        words = running.locator(".instruction").inner_text()
        if "Hold still" in words:
            break
        if "draw back" in words:
            push(page, "ArrowUp", 1)
        else:
            push(page, "Shift+ArrowDown" if words.startswith("Reach") else "ArrowDown", 1)
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("passed")
    expect(dialog).not_to_contain_text("not passed")
    passed = dialog.get_by_text("✓ passed").count()  # a busy computer loses readings, and then nothing is judged
    dialog.get_by_role("button", name="Use as expert").click()
    expect(dialog.get_by_role("button", name="This is now the expert")).to_be_visible()
    dialog.get_by_role("button", name="Try again").click()
    expect(page.locator(".running")).to_be_visible()
    expect(page.locator(".header")).to_contain_text("Force on")
    for _ in range(60):
        push(page, "Shift+ArrowDown", 10)
        if dialog.count():
            break
    expect(dialog.locator(".trace-place")).to_contain_text("Dashed: the expert")
    passed += dialog.get_by_text("✓ passed").count()  # a slow computer may pass it on the way
    dialog.get_by_role("button", name="Replay").click()
    expect(page.get_by_role("group", name="Replay")).to_be_visible()
    expect(page.locator(".force-depth .plot-legend")).to_contain_text("expert")
    the_view_shows_the_expert(page)
    page.get_by_role("button", name="Back to live").first.click()

    tab(page, "Exercises")
    past = page.locator(".past-results")
    expect(past.locator(".progress").get_by_role("row", name="Ann")).to_contain_text(f"2{passed}")
    rows = saved(page, past.get_by_role("button", name="csv"), tmp_path).read_text(encoding="utf-8").splitlines()
    assert len(rows) == 3 and all("Ann" in row for row in rows[1:])
    lines = saved(page, past.get_by_role("button", name="xapi"), tmp_path).read_text(encoding="utf-8").splitlines()
    verbs = [json.loads(line)["verb"]["id"].rsplit("/")[-1] for line in lines]
    assert len(verbs) == 2 and verbs.count("passed") == passed

    page.get_by_role("textbox", name="Your name").fill("Ben")
    page.keyboard.press("Enter")
    expect(past).to_contain_text("No results yet.")
    past.get_by_label("Whole class").check()
    expect(past).to_contain_text("Results of the class 3b")
    expect(past.locator(".progress").get_by_role("row", name="Ann")).to_contain_text(f"2{passed}")
    rows = saved(page, past.get_by_role("button", name="csv"), tmp_path).read_text(encoding="utf-8").splitlines()
    assert len(rows) == 3 and all("Ann" in row and "3b" in row for row in rows[1:])


def the_view_shows_the_expert(page):
    """At a moment of the replay, the picture without the expert's needle is another one."""
    for _ in range(4):
        page.get_by_role("group", name="Replay").get_by_role("button", name="Next event").click()
    tab(page, "Recordings")
    compared = page.locator(".recording", has=page.get_by_role("button", name="Stop", exact=True))
    title = compared.locator("strong").get_attribute("title")
    row = page.locator(".recording", has=page.get_by_title(title, exact=True))
    for _ in range(10):  # a busy computer draws the view coarser for a while
        with_expert = still_picture(page)
        row.get_by_role("button", name="Stop", exact=True).click()
        without = still_picture(page)
        row.get_by_role("button", name="Compare").click()
        if changed(with_expert, without) > 5 * changed(with_expert, still_picture(page)):
            return
    raise AssertionError("the picture is the same without the expert's needle")


def changed(one, other):
    """The number of pixels that are clearly not the same."""
    return int((np.abs(one - other).max(axis=2) > 8).sum())


@pytest.mark.parametrize("studio", [("blind",)], indirect=True)
def test_a_blind_exercise_is_moved_at_once_and_tells_no_depth_to_the_keyboard(page):
    ready(page)
    tab(page, "Exercises")
    page.locator("article.exercise", has_text=TITLE).get_by_role("button", name="Start").click()
    expect(page.locator(".running")).to_be_visible()
    page.reload()
    expect(page.locator(".running")).to_be_visible()
    expect(page.get_by_role("tab", name="Exercises")).to_have_attribute("aria-selected", "true")
    expect(view(page)).to_be_focused()  # the keys move the needle without a click
    expect(page.locator(".hold-ring")).to_be_hidden()
    expect(page.locator(".phases tbody")).to_contain_text("second membrane")
    for _ in range(20):  # into the first one
        push(page, "Shift+ArrowDown", 1)
        if "sticking" in (page.locator(".phases tbody").text_content() or ""):
            break
    expect(page.locator(".phases tbody")).to_contain_text("sticking")
    seen = (
        "[...document.querySelectorAll('.phases > * *')].some((one) => getComputedStyle(one).visibility !== 'hidden')"
    )
    assert not page.evaluate(seen)
    plot = page.locator(".time-plots")
    expect(plot.locator(".plot-save")).to_be_hidden()
    plot.locator("canvas").last.focus()
    page.keyboard.press("ArrowLeft")
    expect(plot.locator("[aria-live]")).to_contain_text("model force")
    expect(plot.locator("[aria-live]")).not_to_contain_text("mm")
    page.keyboard.press("Escape")  # back to the present moment
    tab(page, "Hand")
    expect(page.get_by_role("button", name="Start strokes")).to_be_disabled()
    for _ in range(200):  # as somebody does who looks at nothing but the plot of the force
        if events(page, "pop").count() == 2 or page.get_by_role("dialog").count():
            break
        push(page, "ArrowDown", 1)
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("Hold the whole tip behind the second membrane for 2 s")
    expect(dialog).to_contain_text("passed")
    expect(dialog).not_to_contain_text("not passed")
    dialog.get_by_role("button", name="Close", exact=True).click()
    assert page.evaluate(seen)  # the place of the needle is no secret any more

"""The result of an attempt: one thing to change, its moment again, and pages that look on."""

import pytest
from axe import AXE, check
from person import opened, own_exercise, push, ready, tab, view, whole_at
from playwright.sync_api import expect
from studio_process import StudioProcess

TITLE = "Over at a touch"


@pytest.fixture
def studio(tmp_path):
    """A studio that lists an exercise that is lost with the first force."""
    limit = 'kind = "peak_force"\nat_most_N = 0.02'
    file = own_exercise(tmp_path, TITLE, ('kind = "time_limit"\nseconds = 60', limit))
    with StudioProcess(tmp_path, "k06-fig10", more=["--exercise", str(file)]) as running:
        yield running


def lose(page):
    """Pushes until the result is there."""
    expect(page.locator(".running")).to_be_visible()
    expect(page.locator(".header")).to_contain_text("Force on")
    for _ in range(60):
        push(page, "Shift+ArrowDown", 3)
        if page.get_by_role("dialog").count():
            break


def test_a_key_that_is_still_held_when_the_result_comes_does_not_scroll_it(page):
    ready(page)
    tab(page, "Exercises")
    page.locator("article.exercise", has_text=TITLE).get_by_role("button", name="Start").click()
    expect(page.locator(".running")).to_be_visible()
    page.set_viewport_size({"width": 720, "height": 450})
    dialog = page.get_by_role("dialog")
    view(page).focus()
    for _ in range(400):
        page.keyboard.down("ArrowDown")
        page.wait_for_timeout(50)
        if dialog.count():
            break
    for _ in range(20):
        page.keyboard.down("ArrowDown")
    page.wait_for_timeout(200)  # a scroll is smooth
    assert dialog.evaluate("e => e.scrollTop") == 0
    page.keyboard.up("ArrowDown")
    for _ in range(400):  # pressed for the dialog
        page.keyboard.press("ArrowDown")
        page.wait_for_timeout(50)
        if dialog.evaluate("e => e.scrollTop"):
            break
    else:
        raise AssertionError("the dialog does not scroll")


def test_the_coach_shows_its_moment_and_a_projector_and_a_phone_that_look_on_follow(page, studio, browser):
    ready(page)
    page.get_by_role("button", name="Go to the tabs").press("Enter")  # past the plots
    expect(page.get_by_role("tab", selected=True)).to_be_focused()
    tab(page, "Exercises")
    card = page.locator("article.exercise", has_text=TITLE)
    with (
        opened(browser, studio.url, bench=False) as projector,
        opened(browser, studio.url, bench=False) as phone,
    ):
        phone.set_viewport_size({"width": 390, "height": 844})
        expect(phone.locator(".stage-number")).to_contain_text("N")
        projector.get_by_role("button", name="Pause").click()
        expect(projector.locator(".stage-sentence")).to_contain_text("Paused")
        card.get_by_role("button", name="Start").click()
        instruction = page.locator(".running .instruction")
        expect(instruction).not_to_be_empty()
        for watching in (projector, phone):
            expect(watching.locator(".stage-sentence")).to_have_text(instruction.inner_text())
            expect(watching.get_by_role("button", name="Pause")).to_be_visible()
        lose(page)
        dialog = page.get_by_role("dialog")
        expect(dialog.locator(".coach.change p")).to_have_count(1)
        expect(dialog.locator(".coach.change")).to_contain_text("that are allowed")
        again = dialog.locator("footer").get_by_role("button").first
        expect(again).to_have_text("Try again")
        for size in ((720, 450), (390, 844), (1440, 900)):
            whole_at(page, size, again, dialog.get_by_role("button", name="Close", exact=True))
        for watching in (projector, phone):
            shown = watching.get_by_role("dialog")
            expect(shown).to_contain_text("You pushed with more than 0.02 N")
            expect(shown.get_by_role("button", name="Try again")).to_have_count(0)

        projector.evaluate(AXE.read_text(encoding="utf-8"))
        check(projector, "a result on the stage", "dialog")

        dialog.get_by_role("button", name="Watch this moment, slowly").click()
        replay = page.locator(".player")
        expect(replay).to_contain_text("The moment, slowly:")
        expect(dialog).to_be_hidden()
        replay.get_by_role("button", name="Back to live").click()
        expect(dialog).to_contain_text("You pushed with more than 0.02 N")  # it is here again

        # One of them watches the moment, and nobody comes back to it.
        projector.get_by_role("dialog").get_by_role("button", name="Watch this moment, slowly").click()
        expect(projector.locator(".stage-sentence")).to_contain_text("The worst moment")
        dialog.get_by_role("button", name="Try again").click()
        expect(page.locator(".running")).to_be_visible()
        for watching in (projector, phone):
            expect(watching.get_by_role("dialog")).to_be_hidden()
            expect(watching.locator(".stage-sentence")).to_have_text(instruction.inner_text())

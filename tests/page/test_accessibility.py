"""axe-core finds nothing serious or moderate in the states of the page, light and dark; and no address is missing."""

import pytest
from axe import AXE, check
from person import PATIENCE, ready, tab
from playwright.sync_api import Browser, Page, expect
from studio_process import StudioProcess


@pytest.fixture
def studio(tmp_path):
    with StudioProcess(tmp_path, "venipuncture") as running:
        yield running


def the_panels_change(page: Page) -> None:
    """By keyboard: a wider view, two panels swapped, one panel alone, and the layout for a projector."""
    picture = page.locator(".panel.view")
    before = picture.bounding_box()
    page.get_by_role("separator", name="Width of the left panels").press("ArrowRight")
    wider = picture.bounding_box()
    assert before and wider and wider["width"] > before["width"]
    page.locator(".view .menu summary").press("Enter")
    page.get_by_role("button", name="Swap with Against time").press("Enter")
    expect(picture).to_have_attribute("data-place", "d")
    page.get_by_role("button", name="Maximise Membranes").press("Enter")
    expect(page.locator(".panel.view")).to_be_hidden()
    page.keyboard.press("Escape")
    page.reload()
    expect(picture).to_have_attribute("data-place", "d")  # it keeps its place
    page.evaluate(AXE.read_text(encoding="utf-8"))
    page.keyboard.press("Alt+p")
    expect(page.locator(".side")).to_be_hidden()


def parts_are_opened(page: Page) -> None:
    """Parts that are closed at first: the estimate while it runs, every part of the scene's form, slice and help."""
    tab(page, "Lab").get_by_role("checkbox", name="Estimate").check()
    expect(page.locator(".estimate")).to_be_visible()
    check(page, "the estimate while it runs")
    side = tab(page, "Scene")
    side.locator("details").evaluate_all("parts => parts.forEach(part => { part.open = true; })")
    expect(side.get_by_text("Tail length").first).to_be_visible()
    page.locator(".view-main .view-tools").get_by_role("button", name="Slice", exact=True).click()
    page.locator(".view-help summary").click()
    check(page, "the whole form, the slice and the help")
    page.get_by_role("button", name="Close the slice").click()


def test_axe_finds_nothing_in_any_state_and_the_page_asks_for_no_missing_address(browser: Browser, studio):
    context = browser.new_context(viewport={"width": 1440, "height": 900}, device_scale_factor=0.5)
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    missing: list[str] = []
    page.on("response", lambda answer: missing.append(answer.url) if answer.status >= 400 else None)
    page.goto(studio.url)
    page.evaluate(AXE.read_text(encoding="utf-8"))
    expect(page.locator(".tour")).to_be_visible()
    check(page, "the tour")
    ready(page)
    for name in ("Hand", "Scene", "Recordings", "Exercises", "Lab", "Health"):
        tab(page, name)
        check(page, f"the tab {name}")
    parts_are_opened(page)
    tab(page, "Health")
    page.get_by_role("button", name="Try a fault").click()
    expect(page.locator(".fault")).to_contain_text("The force is off")
    check(page, "a fault")
    page.locator(".fault").get_by_role("button", name="Turn force on").click()
    expect(page.locator(".fault")).to_be_hidden()  # the tabs move up when it goes
    tab(page, "Scene")
    friction = page.get_by_role("textbox", name="Friction").first
    friction.fill("36")
    friction.press("Enter")
    expect(friction).to_have_attribute("aria-invalid", "true")
    check(page, "a wrong value")
    tab(page, "Exercises")
    page.locator("article.exercise").first.get_by_role("button", name="Start").click()
    expect(page.locator(".running")).to_be_visible()
    check(page, "a running exercise")
    page.locator(".running").get_by_role("button", name="End").click()
    expect(page.locator(".running")).to_be_hidden()
    the_panels_change(page)
    check(page, "the projector layout")
    context.close()
    assert not missing, missing

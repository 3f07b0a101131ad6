"""axe-core finds nothing serious or moderate in any state (axe.py: at which sizes); and no address is missing."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from axe import AXE, USUAL, check, none_found
from person import new_context, own_exercise, ready, tab
from playwright.sync_api import Browser, Page, expect
from states import SHORT, attempt_states, live_states
from studio_process import StudioProcess


@pytest.fixture
def studio(tmp_path):
    """A studio with an exercise that is over a second after the first contact."""
    file = own_exercise(tmp_path, SHORT, ("seconds = 60", "seconds = 1"))
    with StudioProcess(tmp_path, "venipuncture", more=["--exercise", str(file)]) as running:
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


def with_axe(page: Page, url: str) -> Page:
    page.goto(url)
    page.evaluate(AXE.read_text(encoding="utf-8"))
    return page


@contextmanager
def visited(browser: Browser, url: str, **cookie: str) -> Iterator[Page]:
    """The page with axe-core in it. A missing address fails the test."""
    context = new_context(browser, scale=0.2, viewport={"width": USUAL[0], "height": USUAL[1]})
    context.add_cookies([{"name": name, "value": value, "url": url} for name, value in cookie.items()])
    page = context.new_page()
    missing: list[str] = []
    page.on("response", lambda answer: missing.append(answer.url) if answer.status >= 400 else None)
    yield with_axe(page, url)
    assert not missing, missing
    context.close()


def test_axe_finds_nothing_in_any_state_of_a_live_run(browser: Browser, studio):
    with visited(browser, studio.url) as page:
        for name, part in live_states(page):
            check(page, name, part)
        the_panels_change(page)
        check(page, "the projector layout")


def test_axe_finds_nothing_in_attempts_recordings_and_the_lab_and_without_a_connection(browser: Browser, studio):
    with visited(browser, studio.url, punctura_sound="off") as page:
        for name, part in attempt_states(page):
            check(page, name, part)
        viewer = with_axe(page.context.new_page(), studio.url)
        expect(viewer.get_by_role("button", name="Take control").first).to_be_visible()
        check(viewer, "a page without control", ".header, .side")
        studio.end()
        expect(viewer.locator(".header")).to_contain_text("No connection")
        check(viewer, "a page without connection", ".header, .side")


# A mouse hits a line between panels, which is long.
SMALL = """(least) => [...document.querySelectorAll('button, summary, select, input, a[href], [role=tab]' +
  (least > 24 ? ', [role=separator]' : ''))]
  .filter((part) => part.checkVisibility({opacityProperty: true, visibilityProperty: true}))
  .map((part) => {
    const target = part.closest('label') ?? (part.labels?.[0]?.contains(part) ? part.labels[0] : part);
    const {width, height} = target.getBoundingClientRect();
    return {part: part.outerHTML.slice(0, 160), width, height};
  })
  .filter(({width, height}) => width > 1 && height > 1 && (width < least - 0.5 || height < least - 0.5))"""
OF_PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}


def small_in_tabs(page: Page, least: int) -> dict[str, object]:
    small = {"the tour": page.evaluate(SMALL, least)}
    ready(page)
    for name in ("Hand", "Scene", "Exercises", "Recordings", "Lab", "Health"):
        tab(page, name)
        small[name] = page.evaluate(SMALL, least)
    return {name: parts for name, parts in small.items() if parts}


def test_for_a_mouse_each_target_has_24_pixels(page: Page):
    expect(page.locator(".tour")).to_be_visible()
    assert not small_in_tabs(page, 24)


def test_for_a_finger_each_target_has_44_pixels_and_axe_finds_nothing(browser: Browser, studio):
    context = new_context(browser, scale=0.2, **OF_PHONE)
    page = with_axe(context.new_page(), studio.url)
    expect(page.locator(".tour")).to_be_visible()
    assert page.evaluate("matchMedia('(pointer: coarse)').matches")
    assert not small_in_tabs(page, 44)
    none_found(page, "a phone with fingers")
    context.close()

"""The states of the stage that screenshots show, and how a person gets there."""

import sys
from collections.abc import Callable
from pathlib import Path

from chromium import on_the_bench
from playwright.sync_api import Page, expect

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "page"))

from person import NO_WEBGL, ready, tab

Act = Callable[[Page], None]
STEP_MS = 60  # for a step of the hand


def opening(page: Page) -> None:
    """The stage, as it opens."""
    expect(page.locator(".stage-number")).to_contain_text("N")
    expect(page.locator(".stage-sentence")).to_contain_text("push until it gives")


def steps(page: Page, times: int) -> None:
    """Moves the needle in by 1 mm so many times, and waits for each."""
    page.get_by_role("application").first.focus()  # without WebGL, it has another name
    for _ in range(times):
        page.keyboard.press("Shift+ArrowDown")
        page.wait_for_timeout(STEP_MS)


def in_tissue(page: Page) -> None:
    opening(page)
    steps(page, 14)


def gave(page: Page) -> None:
    """After the first pop."""
    opening(page)
    for _ in range(200):
        steps(page, 1)
        if page.locator(".stage-marks button").count():
            break


def slowly(page: Page) -> None:
    gave(page)
    page.locator(".stage-marks button").first.click()
    expect(page.get_by_role("group", name="Replay")).to_be_visible()


def passed_through(page: Page) -> None:
    """All membranes of the scene."""
    opening(page)
    steps(page, 60)


def without_webgl(page: Page) -> None:
    page.add_init_script(NO_WEBGL)
    page.reload()
    gave(page)


def tried(page: Page) -> None:
    """An exercise that has begun, led back to the stage."""
    opening(page)
    page.get_by_role("button", name="More").click()
    exercise_begun(page)
    expect(page.locator(".stage-sentence")).to_be_visible()


def exercise_begun(page: Page, name: str = "venipuncture") -> None:
    """From the bench."""
    ready(page)
    tab(page, "Exercises")
    page.locator(f"[data-exercise={name}]").get_by_role("button", name="Start").click()
    expect(page.locator(".running")).to_be_visible()


def trying(page: Page) -> None:
    tried(page)
    steps(page, 14)


def coached(page: Page) -> None:
    tried(page)
    missed(page)


def missed(page: Page) -> None:
    for _ in range(100):
        steps(page, 5)
        if page.get_by_role("dialog").count():
            break
    expect(page.locator(".trace svg")).to_be_visible()


def worst_moment(page: Page) -> None:
    coached(page)
    page.get_by_role("dialog").get_by_role("button", name="Watch this moment, slowly").click()
    expect(page.locator(".player")).to_contain_text("The moment, slowly")


def watched(page: Page) -> None:
    """A page that looks on while another one tries."""
    other = another(page)
    exercise_begun(other)
    steps(other, 14)


def watched_result(page: Page) -> None:
    other = another(page)
    exercise_begun(other)
    missed(other)
    expect(page.get_by_role("dialog")).to_be_visible()


def another(page: Page) -> Page:
    """A page at the bench in a browser of its own that has taken control."""
    opening(page)
    browser = page.context.browser
    assert browser
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    on_the_bench(context)
    other = context.new_page()
    page.on("close", lambda: context.close())
    token = page.evaluate("sessionStorage.getItem('punctura.token')")
    other.goto(f"{page.url.partition('?')[0]}?token={token}")
    other.get_by_role("button", name="Take control").first.click()
    return other


# The states of the stage.
STAGE: tuple[tuple[str, str, Act], ...] = (
    ("stage-opening", "venipuncture", opening),
    ("stage-tissue", "venipuncture", in_tissue),
    ("stage-pop", "venipuncture", gave),
    ("stage-slowly", "venipuncture", slowly),
    ("stage-six", "epidural", passed_through),
    ("stage-glass", "k06-fig12", gave),
    ("stage-slice", "venipuncture", without_webgl),
    ("stage-tried", "venipuncture", tried),
    ("stage-trying", "venipuncture", trying),
    ("stage-coached", "venipuncture", coached),
    ("stage-worst", "venipuncture", worst_moment),
    ("stage-watched", "venipuncture", watched),
    ("stage-watched-result", "venipuncture", watched_result),
)

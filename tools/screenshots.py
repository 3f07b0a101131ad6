"""Takes screenshots of the studio in every state, docs/images/studio-*.png, in the Chromium of the end-to-end tests.

    python tools/screenshots.py [--out FOLDER]

Laptop (1440 x 900), tablet (900 x 1200) and phone (390 x 844), light and dark. Check the pictures by eye.
"""

from __future__ import annotations

import argparse
import io
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from chromium import launch
from PIL import Image
from playwright.sync_api import Browser, Page, expect, sync_playwright
from studio_process import StudioProcess

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "page"))

from person import PATIENCE, drag_in, push, ready, tab  # noqa: E402
from traced import answer, dropped  # noqa: E402

LAPTOP, TABLET, PHONE = (1440, 900), (900, 1200), (390, 844)


def tour(page: Page) -> None:
    expect(page.get_by_role("region", name="Tour")).to_be_visible(timeout=PATIENCE)
    expect(page.locator(".header")).to_contain_text("Force on", timeout=PATIENCE)


def popped(page: Page) -> None:
    ready(page)
    drag_in(page, pops=1)


def again(page: Page) -> None:
    popped(page)
    page.get_by_role("button", name="Show the pop again, slowly", exact=True).first.click()
    bar = page.get_by_role("group", name="Replay")
    bar.get_by_role("button", name="Next event").click()
    for _ in range(8):
        bar.get_by_role("button", name="Forward one tick").click()


def editor(page: Page) -> None:
    popped(page)
    tab(page, "Scene")
    page.get_by_text("Compare with the other solver").click()


def wrong_value(page: Page) -> None:
    ready(page)
    tab(page, "Scene")
    friction = page.get_by_role("textbox", name="Friction").first
    friction.fill("3.6")
    friction.press("Enter")
    expect(friction).to_have_attribute("aria-invalid", "true", timeout=PATIENCE)


def fault(page: Page) -> None:
    ready(page)
    tab(page, "Health")
    page.get_by_role("button", name="Try a fault").click()
    expect(page.locator(".fault")).to_contain_text("The force is off", timeout=PATIENCE)


def replay(page: Page) -> None:
    ready(page)
    tab(page, "Recordings")
    page.get_by_role("button", name="Record", exact=True).click()
    expect(page.locator(".record-line")).to_contain_text("0 lost", timeout=PATIENCE)
    expect(page.locator(".header")).to_contain_text("Force on", timeout=PATIENCE)
    drag_in(page, pops=1)
    page.get_by_role("button", name="Stop", exact=True).click()
    page.locator(".recording").first.get_by_role("button", name="Replay", exact=True).click()
    bar = page.get_by_role("group", name="Replay")
    expect(bar).to_be_visible(timeout=PATIENCE)
    for _ in range(2):
        bar.get_by_role("button", name="Next event").click()


def exercise(page: Page) -> None:
    ready(page)
    tab(page, "Exercises")
    page.locator("article.exercise", has_text="Venipuncture").get_by_role("button", name="Start").click()
    expect(page.locator(".running")).to_be_visible(timeout=PATIENCE)
    expect(page.locator(".header")).to_contain_text("Force on", timeout=PATIENCE)
    for _ in range(200):
        push(page, "ArrowDown", 2)
        page.wait_for_timeout(100)  # a hand that keeps pushing and misses the flash-back
        if page.get_by_role("dialog").count():
            break
    expect(page.get_by_role("dialog")).to_contain_text("Peak model force", timeout=PATIENCE)
    expect(page.locator(".trace svg")).to_be_visible(timeout=PATIENCE)


def sliced(page: Page) -> None:
    popped(page)
    page.get_by_role("button", name="Slice", exact=True).click()


def in_the_epidural(page: Page) -> None:
    ready(page)
    push(page, "Shift+ArrowDown", 30)


def identified(page: Page) -> None:
    ready(page)
    form = dropped(page)
    answer(form)
    form.get_by_role("button", name="Identify").click()
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("button", name="Save report")).to_be_enabled(timeout=PATIENCE)
    if page.viewport_size == {"width": PHONE[0], "height": PHONE[1]}:
        dialog.get_by_role("region", name="Parameters").evaluate("e => e.scrollIntoView({block: 'center'})")


def projector(page: Page) -> None:
    in_the_epidural(page)
    page.keyboard.press("Alt+p")


# name, scene, action, size, colour scheme
STATES: tuple[tuple[str, str, Callable[[Page], None], tuple[int, int], str], ...] = (
    ("tour", "venipuncture", tour, LAPTOP, "light"),
    ("pop", "k06-fig10", popped, LAPTOP, "light"),
    ("pop-dark", "k06-fig10", popped, LAPTOP, "dark"),
    ("again", "venipuncture", again, LAPTOP, "light"),
    ("vein", "venipuncture", popped, LAPTOP, "light"),
    ("editor", "k06-fig10", editor, LAPTOP, "light"),
    ("error", "k06-fig10", wrong_value, LAPTOP, "light"),
    ("fault", "k06-fig10", fault, LAPTOP, "dark"),
    ("replay", "k06-fig12", replay, LAPTOP, "light"),
    ("result", "venipuncture", exercise, LAPTOP, "light"),
    ("slice", "venipuncture", sliced, LAPTOP, "light"),
    ("epidural", "epidural", in_the_epidural, LAPTOP, "light"),
    ("projector", "epidural", projector, LAPTOP, "dark"),
    ("trace", "k06-fig10", identified, LAPTOP, "light"),
    ("trace-dark", "k06-fig10", identified, LAPTOP, "dark"),
    ("trace-phone", "k06-fig10", identified, PHONE, "light"),
    ("trace-phone-dark", "k06-fig10", identified, PHONE, "dark"),
    ("phone", "venipuncture", popped, PHONE, "light"),
    ("tablet", "venipuncture", popped, TABLET, "light"),
    ("tablet-dark", "epidural", popped, TABLET, "dark"),
)


def take(browser: Browser, out: Path, wanted: list[str]) -> None:
    for name, scene, act, (width, height), colours in STATES:
        if wanted and name not in wanted:
            continue
        with tempfile.TemporaryDirectory() as folder:
            studio = StudioProcess(Path(folder), scene)
            context = browser.new_context(
                viewport={"width": width, "height": height}, color_scheme=colours, reduced_motion="reduce"
            )
            context.add_cookies([{"name": "punctura_sound", "value": "off", "url": studio.url}])
            page = context.new_page()
            page.goto(studio.url, timeout=PATIENCE)
            act(page)
            page.wait_for_timeout(1500)  # until plots and view are drawn
            whole = width < 1080 and not page.get_by_role("dialog").count()  # a dialog covers what the page shows
            shot = page.screenshot(full_page=whole)
            Image.open(io.BytesIO(shot)).quantize(256).save(out / f"studio-{name}.png", optimize=True)
            context.close()
            studio.end()
        print(out / f"studio-{name}.png", flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "images")
    parser.add_argument("names", nargs="*", help="some of: " + " ".join(state[0] for state in STATES))
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    with sync_playwright() as playwright:
        browser = launch(playwright)
        take(browser, arguments.out, arguments.names)
        browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Passes the ready exercises at the page with one device alone: a mouse, a keyboard, or fingers on a phone.

    python tools/pass_exercises.py [--hand mouse|keys|fingers] [NAME ...]

The hand knows what the page says, and nothing else. It goes on in steps, and looks after each. It draws back when the
sentence says so, and holds still; it goes more slowly when the sentence asks for the whole tip. In the blind exercise
it counts how often the number of the force falls. As a person, it tries up to three times, each time more slowly. An
attempt in which a busy computer missed readings is repeated.
Prints a line for each exercise, with the verdict and what the coach says; the exit status is 1 if one was not passed.
"""

import argparse
import re
import sys
import tempfile
import time
from math import hypot
from os import getloadavg
from pathlib import Path

from chromium import launch
from playwright.sync_api import Browser, Locator, Page, expect, sync_playwright
from punctura.exercise import exercise_names
from studio_process import StudioProcess

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "page"))

from person import PATIENCE, new_context

LAPTOP, PHONE = {"width": 1440, "height": 900}, {"width": 390, "height": 844}
STEP_MS, LOOK_MS = 60, 250  # after a step: on the way, and near the place
MOST_MISSED = 6  # attempts in a row in which the computer missed readings
FALL = 0.08  # N, of the number of the force when something gave way
NUMBER = re.compile(r"\d[\d.]*")
ASIDE = {"rolling-vein": 4.0}  # mm towards you, before the needle goes in: the list says so
VIEW = ".view-main > canvas"
# The sentence, the number, what a screen reader hears, and a result: in one call, because a busy computer is slow to
# answer each.
SEEN = """() => [".stage-sentence", ".stage-number", ".view .only-read[role=status]", "dialog[open]"]
  .map((at) => document.querySelector(at)?.innerText ?? "")"""
NEEDLE = f"document.querySelector('{VIEW}').dataset.needle.split(' ').map(Number)"  # its ends, as shares of the view


def number(words: Locator) -> float:
    return float(words.inner_text().replace("\N{MINUS SIGN}", "-"))


class Keys:
    use = staticmethod(Locator.click)

    def __init__(self, page: Page) -> None:
        self.page = page
        page.locator(VIEW).focus()

    def move(self, way: int, far: bool = False) -> None:
        """One step in, or out. far: larger, because nothing is near."""
        self.page.keyboard.press(("Shift+" if far else "") + ("ArrowDown" if way > 0 else "ArrowUp"))

    def aside(self, way: float) -> None:
        for _ in range(round(way / 0.25)):
            self.page.keyboard.press("PageDown")
            self.page.wait_for_timeout(STEP_MS)

    def thumb(self, down: bool) -> None:
        (self.page.keyboard.down if down else self.page.keyboard.up)(" ")

    def button(self, name: str) -> Locator:
        return self.page.get_by_role("button", name=name, exact=True)


class Mouse(Keys):
    """Drags along the needle, and anew where the page ends. While it holds the plunger's button, its wheel moves."""

    pixels = 2.0  # of a step
    at: tuple[float, float] | None = None  # where the pointer is pressed
    way = (0.0, 1.0)
    pushing = False

    def move(self, way: int, far: bool = False) -> None:
        if self.pushing:
            return self.page.mouse.wheel(0, 100 * way)
        box = self.page.locator(VIEW).bounding_box()
        assert box
        wide, high = box["width"], box["height"]
        if self.at is None:
            left, top, right, bottom = self.page.evaluate(NEEDLE)
            across, down = (right - left) * wide, (bottom - top) * high
            self.way = (across / hypot(across, down), down / hypot(across, down)) if across > 0.5 * down else (0.0, 1.0)
            share = 0.3 if way > 0 else 0.6
            self.at = box["x"] + share * wide, box["y"] + (share + 0.05) * high
            self.press(*self.at)
        step = self.pixels * way * (3 if far else 1)
        self.at = self.at[0] + step * self.way[0], self.at[1] + step * self.way[1]
        self.go(*self.at)
        if not (20 < self.at[0] - box["x"] < wide - 20 and 60 < self.at[1] - box["y"] < 0.7 * high):
            self.release()

    def aside(self, way: float) -> None:
        """On the bench: its button "Sideways" makes the drag one along the skin; the tab "Hand" has the place."""
        self.use(self.button("More"))
        self.use(self.page.get_by_role("tab", name="Hand"))
        self.use(self.button("Sideways"))
        self.page.locator(".view-main").scroll_into_view_if_needed()
        box = self.page.locator(".view-main").bounding_box()
        assert box
        place = self.page.get_by_role("row", name="Tip").locator("td").last
        x, y, end = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2, number(place) + way
        self.press(x, y)
        while (left := end - number(place)) > 0.1:
            y += min(2.0, left)
            self.go(x, y)
            self.page.wait_for_timeout(2 * STEP_MS)
        self.release()
        self.use(self.button("Sideways"))
        self.use(self.button("Stage"))
        expect(self.page.locator(".stage-number")).to_be_visible()

    def thumb(self, down: bool) -> None:
        self.pushing = down
        if not down:
            return self.page.mouse.up()
        self.release()
        self.button("Hold to push the plunger").hover()
        self.page.mouse.down()

    def press(self, x: float, y: float) -> None:
        self.page.mouse.move(x, y)
        self.page.mouse.down()

    def go(self, x: float, y: float) -> None:
        self.page.mouse.move(x, y)

    def release(self) -> None:
        self.page.mouse.up()
        self.at = None


class Fingers(Mouse):
    """One drags, another one holds the button of the plunger. A phone shows more tissue in a pixel."""

    pixels = 1.0
    use = staticmethod(Locator.tap)

    def __init__(self, page: Page) -> None:
        self.page = page
        self.tools, self.down = page.context.new_cdp_session(page), dict[int, tuple[float, float]]()

    def send(self, kind: str, fingers: dict[int, tuple[float, float]]) -> None:
        points = [{"id": name, "x": x, "y": y} for name, (x, y) in fingers.items()]
        self.tools.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    def press(self, x: float, y: float, finger: int = 0) -> None:
        self.down[finger] = x, y
        self.send("touchStart", self.down)

    def go(self, x: float, y: float) -> None:
        self.down[0] = x, y
        self.send("touchMove", self.down)

    def release(self, finger: int = 0) -> None:
        if finger in self.down:
            self.send("touchEnd", {finger: self.down.pop(finger)})  # those that are lifted: the others stay
        if finger == 0:
            self.at = None

    def thumb(self, down: bool) -> None:
        if not down:
            return self.release(1)
        box = self.button("Hold to push the plunger").bounding_box()
        assert box
        self.press(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2, 1)


HANDS = {"mouse": Mouse, "keys": Keys, "fingers": Fingers}


def attempt(page: Page, hand: Keys, slower: int) -> str:
    """Tries an exercise that has been started. Returns what the dialog says."""
    asked = page.locator(".stage-sentence").inner_text()
    most, falls, pushing, done = 0.0, 0, False, False
    end = time.monotonic() + 180
    while time.monotonic() < end:
        words, shown, spoken, result = page.evaluate(SEEN)
        force = NUMBER.search(shown)
        if force:  # else it is not known at this moment
            fell = float(force[0]) < most - FALL
            most, falls = float(force[0]) if fell else max(most, float(force[0])), falls + fell
        if result:
            return str(result)
        holds = "Hold still" in words or "let it go" in words or ("second pop" in asked and falls == 2)
        if "plunger" in asked and not done and (holds if pushing else "ligament" in spoken):
            pushing, done = not pushing, pushing
            hand.thumb(pushing)
        if words.startswith("You reached") or holds:
            page.wait_for_timeout(STEP_MS)
            continue
        hand.move(-1 if "raw back" in words else 1, far=words == asked and most == 0)
        near = "hold it" in words
        page.wait_for_timeout(slower * (LOOK_MS if near else STEP_MS))
    return "not passed: no result"


def passes(browser: Browser, name: str, by: str, slower: int) -> bool | None:
    """Tries it once. None: the computer missed readings, which says nothing of the hand."""
    phone = by == "fingers"
    with tempfile.TemporaryDirectory() as folder, StudioProcess(Path(folder), "") as studio:
        context = new_context(browser, bench=False, viewport=PHONE if phone else LAPTOP, has_touch=phone)
        context.add_cookies([{"name": "punctura_sound", "value": "off", "url": studio.url}])
        page = context.new_page()
        page.goto(studio.url)
        expect(page.locator(".stage-number")).to_contain_text("N")
        page.get_by_role("button", name="More").click()
        page.get_by_role("tab", name="Exercises").click()
        page.locator(f"[data-exercise={name}]").get_by_role("button", name="Start").click()
        expect(page.locator(".stage-sentence")).to_be_visible()
        expect(page.locator(".stage-number")).to_have_text("0.00 N")
        began = time.monotonic()
        hand = HANDS[by](page)
        if name in ASIDE:
            hand.aside(ASIDE[name])
        words = " ".join(attempt(page, hand, slower).split())
        context.close()
    passed = "✓ passed" in words
    took = f"after {time.monotonic() - began:.0f} s, load {getloadavg()[0]:.0f}"
    said = words.partition(" Goals ")[0]  # the verdict, its reasons and the coach
    print(f"{name}, {by}: {'passed' if passed else 'NOT PASSED'} {took}: {said}", flush=True)
    return None if "Readings were late or missing" in words else passed


def tried(browser: Browser, name: str, by: str, slower: int) -> bool:
    results = (passes(browser, name, by, slower) for _ in range(MOST_MISSED))
    return next((result for result in results if result is not None), False)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--hand", choices=HANDS, action="append", help="default: each")
    parser.add_argument("names", nargs="*", metavar="NAME")
    arguments = parser.parse_args()
    expect.set_options(timeout=PATIENCE)
    with sync_playwright() as playwright:
        browser = launch(playwright)
        failed = [
            (name, hand)
            for hand in arguments.hand or HANDS
            for name in arguments.names or exercise_names()
            if not any(tried(browser, name, hand, slower) for slower in (1, 2, 3))
        ]
        browser.close()
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())

"""Passes the ready exercises at the page with one device alone: a mouse, a keyboard, or fingers on a phone.

    python tools/pass_exercises.py [--hand mouse|keys|fingers] [NAME ...]

The hand does what the sentence says: it goes on until the place is reached, draws back when it is told to, and holds
still. In the blind exercise it counts the pops that it feels. As a person, it tries up to three times. Prints a line
for each exercise; the exit status is 1 if one was not passed.
"""

import argparse
import sys
import tempfile
import time
from math import hypot
from pathlib import Path

from chromium import launch
from playwright.sync_api import Browser, Locator, Page, expect, sync_playwright
from punctura.exercise import Exercise, exercise_names, load_exercise
from punctura.studio.client import StudioClient
from studio_process import StudioProcess
from warm import warm

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "page"))

from person import PATIENCE, new_context

LAPTOP, PHONE = {"width": 1440, "height": 900}, {"width": 390, "height": 844}
STEP_MS = 60  # between two moves of the hand: with a key's step of 0.25 mm, 4 mm/s
MOST = 3  # steps at once, of a hand that goes on while a busy computer looks at the page
PIXELS = 2.0  # of a move
ASIDE = {"rolling-vein": 4e-3}  # m towards you, before the needle goes in: the vein lies there
VIEW = ".view-main > canvas"
NEEDLE = f"document.querySelector('{VIEW}').dataset.needle.split(' ').map(Number)"  # its ends, as shares of the view


class Keys:
    def __init__(self, page: Page, client: StudioClient) -> None:
        self.page, self.client = page, client
        self.page.locator(VIEW).focus()

    def move(self, steps: int) -> None:
        for _ in range(abs(steps)):
            self.page.keyboard.press("ArrowDown" if steps > 0 else "ArrowUp")

    def aside(self, way: float) -> None:
        for _ in range(round(way / 0.25e-3)):
            self.page.keyboard.press("PageDown")
            self.page.wait_for_timeout(STEP_MS)

    def thumb(self, down: bool) -> None:  # also beside a mouse, which alone cannot do it: the list says so
        self.page.locator(VIEW).focus()
        (self.page.keyboard.down if down else self.page.keyboard.up)(" ")


class Drag(Keys):
    """A mouse: drags along the needle, and anew where the page ends."""

    use = staticmethod(Locator.click)
    at: tuple[float, float] | None = None  # where the pointer is pressed
    way = (0.0, 1.0)

    def move(self, steps: int) -> None:
        box = self.page.locator(VIEW).bounding_box()
        assert box
        wide, high = box["width"], box["height"]
        if self.at is None:
            left, top, right, bottom = self.page.evaluate(NEEDLE)
            across, down = (right - left) * wide, (bottom - top) * high
            self.way = (across / hypot(across, down), down / hypot(across, down)) if across > 0.5 * down else (0.0, 1.0)
            self.at = box["x"] + (0.3 if steps > 0 else 0.6) * wide, box["y"] + (0.35 if steps > 0 else 0.6) * high
            self.press(*self.at)
        self.at = self.at[0] + PIXELS * steps * self.way[0], self.at[1] + PIXELS * steps * self.way[1]
        self.go(*self.at)
        if not (20 < self.at[0] - box["x"] < wide - 20 and 60 < self.at[1] - box["y"] < 0.7 * high):
            self.release()

    def aside(self, way: float) -> None:
        """On the bench: its button "Sideways" makes the drag one along the skin."""
        self.click("More")
        self.click("Sideways")
        box = self.page.locator(".view-main").bounding_box()
        assert box
        x, y, end = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2, self.z() + way
        self.press(x, y)
        while (left := end - self.z()) > 0.1e-3:
            y += min(2.0, 1e3 * left)
            self.go(x, y)
            self.page.wait_for_timeout(2 * STEP_MS)
        self.release()
        self.click("Sideways")
        self.click("Stage")
        expect(self.page.locator(".stage-number")).to_be_visible()

    def z(self) -> float:
        assert self.client.last
        return float(self.client.last.ticks.tip[-1][2])

    def click(self, name: str) -> None:
        self.use(self.page.get_by_role("button", name=name, exact=True))

    def press(self, x: float, y: float) -> None:
        self.page.mouse.move(x, y)
        self.page.mouse.down()

    def go(self, x: float, y: float) -> None:
        self.page.mouse.move(x, y)

    def release(self) -> None:
        self.page.mouse.up()
        self.at = None


class Fingers(Drag):  # one drags, another one holds the button of the plunger
    use = staticmethod(Locator.tap)

    def __init__(self, page: Page, client: StudioClient) -> None:
        self.page, self.client = page, client
        self.tools, self.down = page.context.new_cdp_session(page), dict[int, tuple[float, float]]()

    def send(self, kind: str) -> None:
        points = [{"id": name, "x": x, "y": y} for name, (x, y) in self.down.items()]
        self.tools.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    def press(self, x: float, y: float, finger: int = 0) -> None:
        self.down[finger] = x, y
        self.send("touchStart")

    def go(self, x: float, y: float) -> None:
        self.down[0] = x, y
        self.send("touchMove")

    def release(self, finger: int = 0) -> None:
        self.down.pop(finger, None)
        self.send("touchMove" if self.down else "touchEnd")
        if finger == 0:
            self.at = None

    def thumb(self, down: bool) -> None:
        if not down:
            return self.release(1)
        box = self.page.get_by_role("button", name="Hold to push the plunger").bounding_box()
        assert box
        self.press(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2, 1)


HANDS = {"mouse": Drag, "keys": Keys, "fingers": Fingers}


def attempt(page: Page, client: StudioClient, exercise: Exercise, hand: Keys) -> str:
    """Tries an exercise that has been started. Returns what the dialog says."""
    pushing, done, steps = False, False, 1
    before = sum(event["what"] == "pop" for event in client.of("event"))
    if exercise.name in ASIDE:
        hand.aside(ASIDE[exercise.name])
    with_plunger = any(goal.needs_syringe for goal in exercise.goals)
    wall = exercise.space[0]
    sentence, dialog = page.locator(".stage-sentence"), page.get_by_role("dialog")
    last = time.monotonic()
    end = last + 150
    while not dialog.count() and last < end:
        words, popped = sentence.inner_text(), sum(event["what"] == "pop" for event in client.of("event")) - before
        if with_plunger and not done and popped == wall and not pushing:
            hand.thumb(True)
            pushing = True
        if pushing and client.of("exercise")[-1]["goals"][0]["state"] == "met":  # it gave way
            hand.thumb(False)
            pushing, done = False, True
        if "old still" not in words and not (exercise.file.blind and popped > wall):
            hand.move((-1 if "raw back" in words else 1) * max(1, min(MOST, steps)))
        page.wait_for_timeout(STEP_MS)
        last, steps = time.monotonic(), round(1e3 * (time.monotonic() - last) / STEP_MS)
    return dialog.inner_text() if dialog.count() else "not passed: no result"


def passes(browser: Browser, name: str, hand: str) -> bool:
    phone = hand == "fingers"
    with tempfile.TemporaryDirectory() as folder, StudioProcess(Path(folder), "") as studio:
        context = new_context(browser, bench=False, viewport=PHONE if phone else LAPTOP, has_touch=phone)
        context.add_cookies([{"name": "punctura_sound", "value": "off", "url": studio.url}])
        page = context.new_page()
        page.goto(studio.url)
        expect(page.locator(".stage-number")).to_contain_text("N")
        page.get_by_role("button", name="More").click()
        page.get_by_role("tab", name="Exercises").click()
        page.locator(f"[data-exercise={name}]").get_by_role("button", name="Start").click()
        expect(page.locator(".running")).to_be_visible()
        with StudioClient(studio.url) as client:
            client.wait(lambda: client.last is not None and client.last.ticks.state[-1] == 2)  # force on
            began = time.monotonic()
            words = attempt(page, client, load_exercise(name), HANDS[hand](page, client))
        context.close()
    passed = "not passed" not in words and "passed" in words
    result = "passed" if passed else f"NOT PASSED ({' '.join(words.split())[:200]})"
    print(f"{name}, {hand}: {result} after {time.monotonic() - began:.0f} s", flush=True)
    return passed


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--hand", choices=HANDS, action="append", help="default: each")
    parser.add_argument("names", nargs="*", metavar="NAME")
    arguments = parser.parse_args()
    expect.set_options(timeout=PATIENCE)
    with (
        tempfile.TemporaryDirectory() as folder,
        warm(Path(folder), "seldom") as StudioProcess.program,
        sync_playwright() as playwright,
    ):
        browser = launch(playwright)
        failed = [
            (name, hand)
            for hand in arguments.hand or HANDS
            for name in arguments.names or exercise_names()
            if not any(passes(browser, name, hand) for _ in range(3))
        ]
        browser.close()
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())

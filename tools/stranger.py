"""A person who has never seen the studio, and knows only the words on its page: the time to the first pop.

    python tools/stranger.py [--tries 10] [--keys]

Each try starts a studio without SCENE and a browser with an empty profile. The person reads the sentence of the stage,
drags in the picture until the page says that it gave, and goes on as the page says: draws the needle back, and looks
at the pop again, slowly. With --keys there is no mouse: the person presses Tab until the page says which keys move
the needle. Nothing here knows the page's structure: texts and roles only.
"""

import argparse
import re
import statistics
import sys
import tempfile
import time
from pathlib import Path

from chromium import launch
from playwright.sync_api import FloatRect, Locator, Page, expect, sync_playwright
from studio_process import StudioProcess

PATIENCE = 120_000  # ms, on a machine without a graphics card
READING_MS = 1500  # for a sentence
PIXELS_PER_S = 300  # of a hand that has never done it
STEP_MS = 33  # between two positions of the mouse, or two repeats of a key

SENTENCE = re.compile("push until it gives")
GAVE = re.compile(r"It gave: the (?:model |felt )?force fell by ([0-9.]+)\sN")  # a space at which no line breaks
OUT = "the needle is out"
KEYS = "The keys ↓ and ↑ move the needle."


def said(page: Page) -> str:
    words = page.locator("[role=alert], [role=status]").filter(visible=True).all_inner_texts()
    return " / ".join(" ".join(one.split()) for one in words)


class Mouse:  # drags like a hand: slowly, and anew where the page ends
    def __init__(self, page: Page, words: FloatRect) -> None:
        self.page, self.x = page, words["x"] + 500
        self.top = words["y"] + words["height"] + 100  # the picture is below its sentence
        self.bottom = self.top + 250

    def move(self, down: bool, until: Locator) -> None:
        """One stroke down or up in the picture, or less, if something can be read."""
        begin, end = (self.top, self.bottom) if down else (self.bottom, self.top)
        mouse, started = self.page.mouse, time.monotonic()
        mouse.move(self.x, begin)
        mouse.down()
        while (gone := PIXELS_PER_S * (time.monotonic() - started)) < abs(end - begin) and not until.is_visible():
            mouse.move(self.x, begin + (gone if down else -gone))
            self.page.wait_for_timeout(STEP_MS)
        if not until.is_visible():
            mouse.move(self.x, end)  # also where the page was too slow to follow each step of the hand
        mouse.up()

    def again(self) -> None:
        self.page.get_by_text("again, slowly").filter(visible=True).first.click()


class Keys(Mouse):  # presses Tab until the page names the keys, and then holds one of these
    def __init__(self, page: Page, words: FloatRect) -> None:
        super().__init__(page, words)
        end = time.monotonic() + PATIENCE / 1e3
        while not page.get_by_text(KEYS).is_visible():
            assert time.monotonic() < end, f"the page never named the keys, but: {said(page)}"
            page.keyboard.press("Tab")
            page.wait_for_timeout(STEP_MS)
        page.wait_for_timeout(READING_MS)

    def move(self, down: bool, until: Locator) -> None:
        key = "ArrowDown" if down else "ArrowUp"
        end = time.monotonic() + PATIENCE / 1e3
        while not until.is_visible():
            assert time.monotonic() < end, f"the page never said it, but: {said(self.page)}"
            self.page.keyboard.down(key)  # again while it is down: the keyboard's repeat
            self.page.wait_for_timeout(STEP_MS)
        self.page.keyboard.up(key)

    def again(self) -> None:
        self.page.get_by_role("button", name="again, slowly").first.press("Enter")  # a role is of what can be seen


def try_once(page: Page, url: str, by: type[Mouse]) -> tuple[float, float, str]:
    """The times of the first pop and of the end, s after the sentence appears, and the drop of the force, N."""
    page.set_default_timeout(PATIENCE)
    page.goto(url)
    sentence = page.get_by_text(SENTENCE)
    expect(sentence).to_be_visible(timeout=PATIENCE)
    began = time.monotonic()
    page.wait_for_timeout(READING_MS)
    words = sentence.bounding_box()
    assert words
    hand = by(page, words)

    def until(text: str | re.Pattern[str], down: bool) -> str:
        found = page.get_by_text(text).filter(visible=True).first  # the bench, which is hidden, has the same words
        while not found.is_visible():
            assert time.monotonic() < began + PATIENCE / 1e3, "the page never said it"
            hand.move(down, found)
        return found.inner_text()

    gave = GAVE.search(until(GAVE, down=True))
    first_pop = time.monotonic() - began
    assert gave
    until(OUT, down=False)
    back = page.get_by_role("button", name="Go on")
    while not back.is_visible():  # on a very slow page the 5 s can be over before anybody looks
        hand.again()
    expect(back).to_be_hidden(timeout=PATIENCE)  # it goes back by itself
    return first_pop, time.monotonic() - began, gave[1]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tries", type=int, default=10)
    parser.add_argument("--keys", action="store_true")
    arguments = parser.parse_args()
    pops: list[float] = []
    with sync_playwright() as playwright:
        for i in range(arguments.tries):
            with tempfile.TemporaryDirectory() as folder, StudioProcess(Path(folder), "") as studio:
                browser = launch(playwright)
                page = browser.new_page(viewport={"width": 1440, "height": 900})
                first_pop, whole, drop = try_once(page, studio.url, Keys if arguments.keys else Mouse)
                browser.close()
            pops.append(first_pop)
            print(f"{i + 1}: first pop after {first_pop:.1f} s ({drop} N), all after {whole:.1f} s", flush=True)
    print(f"first pop: median {statistics.median(pops):.1f} s, longest {max(pops):.1f} s, of {len(pops)} tries")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""A person who has never seen the studio, and knows only the words on its page: the time to the first pop.

    python tools/stranger.py [--tries 10]

Each try starts a studio without SCENE and a browser with an empty profile. The person reads the sentence of the stage,
drags in the picture until the page says that it gave, and goes on as the page says: draws the needle back, and looks
at the pop again, slowly. Nothing here knows the page's structure: texts and roles only.
"""

from __future__ import annotations

import argparse
import re
import statistics
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from chromium import launch
from playwright.sync_api import Locator, Page, expect, sync_playwright
from studio_process import StudioProcess

PATIENCE = 120_000  # ms, on a machine without a graphics card
READING_S = 1.5  # for the sentence
PIXELS_PER_S = 300  # of a hand that has never done it
STEP_S = 1 / 30  # between two positions of the mouse
SIZE = {"width": 1440, "height": 900}

SENTENCE = re.compile("push until it gives")
GAVE = re.compile(r"It gave: the (?:model |felt )?force fell by [0-9.]+ N")
OUT = "the needle is out"


class Try(NamedTuple):
    """Times after the sentence appears, s; reading included."""

    first_pop: float
    whole_minute: float
    drop: str


class Mouse:
    """Drags like a hand: slowly, and anew where the page ends."""

    def __init__(self, page: Page, top: float, bottom: float, x: float) -> None:
        self._page, self._top, self._bottom, self._x = page, top, bottom, x

    def drag(self, down: bool, until: Locator) -> None:
        """Drags down or up in the picture, until something can be read."""
        begin, end = (self._top, self._bottom) if down else (self._bottom, self._top)
        deadline = time.monotonic() + PATIENCE / 1e3
        while not until.is_visible():
            assert time.monotonic() < deadline, "the page never said it"
            self._stroke(begin, end, until)

    def _stroke(self, begin: float, end: float, until: Locator) -> None:
        mouse, started = self._page.mouse, time.monotonic()
        mouse.move(self._x, begin)
        mouse.down()
        way, sign = abs(end - begin), 1 if end > begin else -1
        while (gone := PIXELS_PER_S * (time.monotonic() - started)) < way and not until.is_visible():
            mouse.move(self._x, begin + sign * gone)
            self._page.wait_for_timeout(1e3 * STEP_S)
        if not until.is_visible():
            mouse.move(self._x, end)  # also where the page was too slow to follow each step of the hand
        mouse.up()


def try_once(page: Page, url: str) -> Try:
    page.set_default_timeout(PATIENCE)
    page.goto(url)
    sentence = page.get_by_text(SENTENCE)
    expect(sentence).to_be_visible(timeout=PATIENCE)
    began = time.monotonic()
    page.wait_for_timeout(1e3 * READING_S)
    words = sentence.bounding_box()
    assert words
    # The picture is below its sentence.
    below = words["y"] + words["height"]
    hand = Mouse(page, below + 100, below + 350, words["x"] + 500)
    gave = page.get_by_text(GAVE)
    hand.drag(down=True, until=gave)
    first_pop = time.monotonic() - began
    found = GAVE.search(gave.inner_text())
    assert found
    hand.drag(down=False, until=page.get_by_text(OUT))
    back = page.get_by_role("button", name="Go on")
    while not back.is_visible():  # on a very slow page the 5 s can be over before anybody looks
        page.get_by_text("again, slowly").first.click()
    expect(back).to_be_hidden(timeout=PATIENCE)  # it goes back by itself
    return Try(first_pop, time.monotonic() - began, found[0].rsplit(" ", 2)[1])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tries", type=int, default=10)
    arguments = parser.parse_args()
    tries: list[Try] = []
    with sync_playwright() as playwright:
        for i in range(arguments.tries):
            with tempfile.TemporaryDirectory() as folder, StudioProcess(Path(folder), "") as studio:
                browser = launch(playwright)
                page = browser.new_page(viewport=SIZE)
                tries.append(try_once(page, studio.url))
                browser.close()
            now = tries[-1]
            words = f"first pop after {now.first_pop:.1f} s ({now.drop} N), all after {now.whole_minute:.1f} s"
            print(f"{i + 1}: {words}", flush=True)
    pops = [each.first_pop for each in tries]
    print(f"first pop: median {statistics.median(pops):.1f} s, longest {max(pops):.1f} s, of {len(pops)} tries")
    return 0


if __name__ == "__main__":
    sys.exit(main())

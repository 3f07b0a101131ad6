"""A participant's session at the page, by keys alone, whose studio is killed again and again at random moments.

    PYTHONPATH=tools python tests/page/kills.py [KILLS] [SEED]

Fails if an answered trial is lost, or another one comes than is planned. docs/perception.md has a result.
"""

from __future__ import annotations

import random
import re
import sys
import tempfile
import threading
from pathlib import Path

from chromium import launch
from person import opened
from playwright.sync_api import Page, sync_playwright
from sitting import answered, on_disk, sitting, stroke

TRIALS = 20
LONGEST_S = 8.0  # from the first sentence to the kill
BEGUN = re.compile(r"session begins|trials are done|last trial")


def act(page: Page) -> int:
    """What a person does now. Returns how many answers the page said to be on the disk."""
    words = page.locator(".stage-sentence").inner_text()
    if "push the needle" in words:
        stroke(page, 1)
    page.keyboard.press("y" if "Did it pop?" in words or "Do you agree?" in words else "Enter")
    page.wait_for_timeout(50)
    found = re.match(r"Trial (\d+) of|(\d+) of", words)
    return (int(found[1]) - 1 if found[1] else int(found[2])) if found else 0


def main(kills: int = 25, seed: int = 1) -> None:
    draw, folder = random.Random(seed), Path(tempfile.mkdtemp())
    answered(folder, 0)
    with sync_playwright() as playwright:
        browser = launch(playwright)
        studio = sitting(folder)
        with opened(browser, studio.url, bench=False) as page:
            page.route("**/api/noise.wav", lambda route: route.abort())  # 1.7 MB, which no kill concerns
            for kill in range(kills):
                page.locator(".stage-sentence", has_text=BEGUN).wait_for()
                killer = threading.Timer(draw.uniform(0.0, LONGEST_S), studio.kill)
                killer.start()
                answers = [act(page)]
                while killer.is_alive():
                    answers.append(act(page))
                kept = len(on_disk(folder))
                assert kept >= max(answers)
                print(f"kill {kill + 1}: {kept} of {TRIALS} trials are on the disk", flush=True)
                studio = sitting(folder, studio.port)
            while not page.locator(".stage-sentence").inner_text().startswith("That was the last trial"):
                act(page)
        studio.end()
        browser.close()
    assert len(on_disk(folder)) == TRIALS
    print(f"{kills} kills, {TRIALS} answered trials, none lost, order as planned")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))

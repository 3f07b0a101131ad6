"""A participant who sits at the page, by keys alone, and a studio that is killed again and again at random moments.

    PYTHONPATH=tools python tests/page/sitting.py [KILLS] [SEED]

Fails if an answered trial is lost, or another one comes than is planned. docs/perception.md has a result.
"""

import random
import re
import sys
import tempfile
import threading
import time
from pathlib import Path

from chromium import launch
from person import opened
from playwright.sync_api import Page, expect, sync_playwright
from punctura.perception import Session, load_protocol, read_session
from punctura.perception.course import Course, Line
from studio_process import StudioProcess

PROTOCOL = """
title = "Was there a pop?"
question = "Did it pop?"
consent = "I take part."
noise = true
scene = "k06-fig10"
method = "quest"
task = "yes_no"
seed = 4
[stimulus]
variable = "membrane[0].thickness"
levels = [0.0005, 0.0015, 0.0027, 0.0045]
[trials]
total = 20
[values]
"display.force_scale" = 0.8
[words]
force_off = "Kraft aus (Esc)"
gone = "Das Studio ist weg."
sound = "Eine Taste bringt den Ton."
"""
TOKEN = "a-token-of-this-test"
TRIALS = 20
BEGUN = re.compile(r"trials are done|last trial")
# The page looks for the studio more and more seldom: a kill soon after the last one would have it wait for seconds.
SOON = """const later = window.setTimeout;
window.setTimeout = (call, wait = 0, ...more) => later(call, Math.min(wait, 300), ...more);"""


def sitting(folder: Path, port: int = 0) -> StudioProcess:
    """The studio with the session of P01. port: that of the studio before, whose page finds this one."""
    more = ("--participant", "P01", "--out", str(folder / "people"))
    return StudioProcess(
        folder, str(folder / "mine.toml"), port=port, token=TOKEN, more=more, verb=("perception", "run")
    )


def answered(folder: Path, count: int) -> None:
    """The protocol, and the first answers of P01."""
    (folder / "mine.toml").write_text(PROTOCOL)
    protocol = load_protocol(folder / "mine.toml")
    with Session(protocol, folder / "people", "P01", consent=True) as session:
        for _ in range(count):
            trial = session.next()
            session.add(trial, "yes", [trial.shown.felt])


def sentence(page: Page, words: str) -> None:
    expect(page.locator(".stage-sentence")).to_contain_text(words)


def stroke(page: Page) -> None:
    """Through the membrane and out again, by keys."""
    for key in ("Shift+ArrowDown", "Shift+ArrowUp"):
        for _ in range(20):
            page.keyboard.press(key)
        page.wait_for_timeout(500)


def until(page: Page, words: str) -> None:
    """Strokes until the page says this; "Go on" after a trial that a busy computer has spoilt."""
    repeats = 0
    for _ in range(300):
        now = page.locator(".stage-sentence").inner_text()
        if words in now:
            return
        if "push the needle" in now:
            stroke(page)
        elif "repeated" in now or "comes back" in now:
            repeats += 1
            assert repeats <= 5, now
            page.keyboard.press("Enter")
        page.wait_for_timeout(100)
    raise AssertionError(f"the page does not say {words!r}, but {now!r}")


def on_disk(folder: Path) -> list[Line]:
    """The answered trials, which are those that the protocol has planned; each has its recording."""
    path = folder / "people" / "P01.jsonl"
    lines = read_session(path)[1] if path.exists() else []
    course = Course(load_protocol(folder / "mine.toml"), 0)
    for line in lines:
        trial = course.next()
        assert trial and (line.trial, line.level) == (trial.number, trial.shown.level)
        assert all((folder / "people" / name).is_file() for name in line.recordings)
        course.add(trial, line.answer)
    return lines


def act(page: Page) -> int:
    """What a person does now. Returns how many answers the page said to be on the disk."""
    words = page.locator(".stage-sentence").inner_text()
    if "push the needle" in words:
        stroke(page)
    if "Do you agree?" in words:
        page.keyboard.type("yes")
    page.keyboard.press("y" if "Did it pop?" in words else "Enter")
    page.wait_for_timeout(50)
    found = re.match(r"Trial (\d+) of|(\d+) of", words)
    return (int(found[1]) - 1 if found[1] else int(found[2])) if found else 0


def main(kills: int = 10, seed: int = 1) -> None:
    start, draw, trials = time.monotonic(), random.Random(seed), TRIALS + kills  # so some are left after the kills
    with tempfile.TemporaryDirectory() as place, sync_playwright() as playwright:
        folder, browser = Path(place), launch(playwright)
        text = PROTOCOL.replace(f"total = {TRIALS}", f"total = {trials}")
        (folder / "mine.toml").write_text(text)  # no session: the page asks for consent
        studio = sitting(folder)
        try:
            with opened(browser, studio.url, script=SOON, bench=False) as page:
                page.set_viewport_size({"width": 480, "height": 320})  # less to draw
                page.locator(".stage-sentence", has_text="agree").wait_for()
                while not on_disk(folder):
                    act(page)
                begun = time.monotonic()
                while len(on_disk(folder)) < 2:
                    act(page)
                longest = 2 * (time.monotonic() - begun)  # to a kill: what two trials take on this computer
                for kill in range(kills):
                    if kill:
                        page.locator(".stage-sentence", has_text=BEGUN).wait_for()
                    before = len(on_disk(folder))
                    killer = threading.Timer(draw.uniform(0.0, longest), studio.kill)
                    killer.start()
                    answers = [act(page)]
                    while killer.is_alive():
                        answers.append(act(page))
                        if max(answers) > before + 1:  # the computer has become faster: the kill is in this trial
                            killer.cancel()
                            time.sleep(draw.uniform(0.0, 1.0))
                            studio.kill()
                    kept = len(on_disk(folder))
                    assert kept >= max(answers)
                    print(f"kill {kill + 1}: {kept} of {trials} trials are on the disk", flush=True)
                    longest *= (1.5, 0.8, 0.5)[min(kept - before, 2)]  # so about every second kill follows an answer
                    studio = sitting(folder, studio.port)
                while not page.locator(".stage-sentence").inner_text().startswith("That was the last trial"):
                    act(page)
        finally:
            studio.end()
        assert len(on_disk(folder)) == trials
    print(f"{kills} kills, {trials} answered trials, none lost, order as planned, {time.monotonic() - start:.0f} s")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))

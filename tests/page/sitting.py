"""A participant who sits at the page, and a studio that may be killed meanwhile."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Page, expect
from punctura.perception import Session, load_protocol, read_session
from punctura.perception.course import Course
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
"""
TOKEN = "a-token-of-this-test"


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


def stroke(page: Page, most: int = 20) -> None:
    """Through the membrane and out again, by keys; again, at most so often, if a slow computer was not through."""
    words = page.locator(".stage-sentence")
    before = words.inner_text()
    for _ in range(most):
        for key in ("Shift+ArrowDown", "Shift+ArrowUp"):
            for _ in range(20):
                page.keyboard.press(key)
            page.wait_for_timeout(500)
        if words.inner_text() != before:
            return


def on_disk(folder: Path) -> list[dict]:
    """The answered trials, which are those that the protocol has planned; each has its recording."""
    path = folder / "people" / "P01.jsonl"
    lines = read_session(path)[1:] if path.exists() else []
    course = Course(load_protocol(folder / "mine.toml"), 0)
    for line in lines:
        trial = course.next()
        assert trial and (line["trial"], line["level"]) == (trial.number, trial.shown.level)
        assert all((folder / "people" / name).is_file() for name in line["recordings"])
        course.add(trial, line["answer"])
    return lines

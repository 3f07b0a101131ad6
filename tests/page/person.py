"""What a person does at the page, in words; every wait is for something to be seen, none for a time."""

import csv
import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from chromium import on_the_bench
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Browser, BrowserContext, Locator, Page, expect
from punctura.exercise import load_exercise

# ms: of every action and every expectation. A test that passes does not wait so long, however busy the computer is.
PATIENCE = 120_000
COMPUTING = 3 * PATIENCE  # of what the Lab computes: its process has the lowest priority
# A picture every 160 ms and not every 17: the processor draws them, and has the rest of its time for the tests.
FEWER_PICTURES = """const next = requestAnimationFrame.bind(window), drop = cancelAnimationFrame.bind(window);
const ends = new Map();
let asked = 0;
window.requestAnimationFrame = (draw) => {
  const id = ++asked;
  const wait = setTimeout(() => {
    const frame = next((now) => {
      ends.delete(id);
      draw(now);
    });
    ends.set(id, () => drop(frame));
  }, 160);
  ends.set(id, () => clearTimeout(wait));
  return id;
};
window.cancelAnimationFrame = (id) => {
  ends.get(id)?.();
  ends.delete(id);
};"""

# For `opened`: a browser without WebGL.
NO_WEBGL = """const before = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...of) {
  return kind.startsWith("webgl") ? null : before.call(this, kind, ...of);
};"""


def new_context(
    browser: Browser, scale: float = 0.5, fewer: bool = True, bench: bool = True, **options: Any
) -> BrowserContext:
    """A context of the browser that is light for the processor, which draws without a graphics card.

    scale: of the resolution. Half of it is a quarter of the pixels, and nobody looks. fewer: pictures a second.
    bench: it remembers the bench; else the stage opens, as for a new visitor.
    """
    context = browser.new_context(device_scale_factor=scale, reduced_motion="reduce", **options)
    if bench:
        on_the_bench(context)
    context.set_default_timeout(PATIENCE)
    if fewer:
        context.add_init_script(FEWER_PICTURES)
    return context


@contextmanager
def opened(
    browser: Browser, url: str, sound: str = "off", script: str = "", fewer: bool = True, bench: bool = True
) -> Iterator[Page]:
    """The page at the address, in a context of its own. Every error of its script fails the test.

    sound: an earlier answer, "on" or "off"; empty: the page asks. script: runs before the page's own. fewer: pictures
    a second than the browser gives. bench: else the stage opens.
    """
    errors: list[str] = []
    context = new_context(browser, fewer=fewer, bench=bench, viewport={"width": 1440, "height": 900})
    if sound:
        context.add_cookies([{"name": "punctura_sound", "value": sound, "url": url}])
    if script:
        context.add_init_script(script)
    page = context.new_page()
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("console", lambda line: errors.append(line.text) if line.text.startswith("THREE.WebGLProgram") else None)
    try:
        page.goto(url)
        yield page
    finally:
        context.close()
    assert not errors, errors


def own_exercise(folder: Path, title: str, *changes: tuple[str, str], of: str = "venipuncture") -> Path:
    """A file with a ready exercise under another title. changes: what to replace in its text, and by what."""
    ready_one = load_exercise(of)
    text = ready_one.path.read_text(encoding="utf-8")
    for before, after in ((f'"{ready_one.title}"', f'"{title}"'), *changes):
        assert before in text, before
        text = text.replace(before, after)
    file = folder / "own_exercise.toml"
    file.write_text(text, encoding="utf-8")
    return file


def ready(page: Page) -> None:
    """Past the tour, with force on."""
    expect(page.locator(".connection-words")).to_have_text("Connected")
    expect(page.locator(".header")).to_contain_text("Force on")  # the tour comes with the first scene, before this
    if page.get_by_role("button", name="Skip").count():
        page.get_by_role("button", name="Skip").click()


def tab(page: Page, name: str) -> Locator:
    page.get_by_role("tab", name=name).click()
    return page.locator(".side")


def view(page: Page) -> Locator:
    return page.get_by_role("application", name="The needle and the membranes")


def still_picture(page: Page) -> NDArray[np.int16]:
    """The picture of the view when it no longer changes, which it does not while a moment of a replay is shown."""
    before = b""
    for _ in range(PATIENCE // 500):
        if (now := view(page).screenshot()) == before:
            break
        before = now
        page.wait_for_timeout(500)
    else:
        raise AssertionError("the view does not rest")
    with Image.open(io.BytesIO(now)) as picture:
        return np.asarray(picture.convert("RGB"), dtype=np.int16)


def events(page: Page, what: str = "") -> Locator:
    return page.locator(f".events-list .event{f'.{what}' if what else ''}")


WHOLE = """(part) => {
  const {left, right, top, bottom} = part.getBoundingClientRect();
  const whole = left >= 0 && right <= innerWidth && top >= 0 && bottom <= innerHeight;
  const over = whole && document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
  return Boolean(over) && part.contains(over) && part.scrollWidth <= part.clientWidth + 1;
}"""


def whole_at(page: Page, size: tuple[int, int], *parts: Locator) -> None:
    """At this size of the window, each part is wholly inside it, without scrolling; nothing covers or clips it."""
    page.set_viewport_size({"width": size[0], "height": size[1]})
    for part in parts:
        handle = part.element_handle()
        page.wait_for_function(WHOLE, arg=handle)


def ticks_come(page: Page, seconds: float = 0.001) -> None:
    """Waits until the page shows a tick that is later than the present one by so much time of the servo loop.

    It also ends when a new run begins, whose time begins at 0.
    """
    shown = "parseFloat(document.querySelector('.phases-when').textContent)"
    passed = f"([start, seconds]) => {shown} >= start + seconds || {shown} < start"
    page.wait_for_function(passed, arg=[page.evaluate(shown), seconds])


def drag_in(page: Page, pops: int, step: int = 12) -> None:
    """Drags the needle in, until so many pops have been told."""
    box = view(page).bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2, box["y"] + 0.2 * box["height"]
    page.mouse.move(x, y)
    page.mouse.down()
    for _ in range(400):
        y += step
        page.mouse.move(x, y)
        ticks_come(page)  # so that the hand has followed, however slow the computer is
        if events(page, "pop").count() >= pops:
            break
    page.mouse.up()
    expect(events(page, "pop").nth(pops - 1)).to_be_attached()  # the hand may have followed through one more


def drag_aside(page: Page, way: int) -> None:
    """Drags across the view by so many pixels, and waits until the hand has followed."""
    box = view(page).bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2, box["y"] + 0.4 * box["height"]
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + way, y, steps=4)
    page.mouse.up()
    ticks_come(page, 0.5)


def push(page: Page, key: str, times: int) -> None:
    """Key after key with the picture in focus: ArrowDown goes in along the needle by 0.25 mm, with Shift by 1 mm."""
    view(page).focus()
    for _ in range(times):
        page.keyboard.press(key)
    ticks_come(page, 0.025 * times)  # the hand has followed


def newton(words: str) -> float:
    """The first force in a text, without its sign."""
    found = re.search(r"(\d+(?:\.\d+)?) ?N\b", words)
    assert found, words
    return float(found[1])


def saved(page: Page, act: Locator, folder: Path) -> Path:
    """Clicks what saves a file, and gives the file."""
    with page.expect_download() as download:
        act.click()
    path = folder / download.value.suggested_filename
    download.value.save_as(path)
    return path


def columns(path: Path) -> dict[str, list[float]]:
    with path.open(newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {name: [_number(row[name]) for row in rows] for name in rows[0]}


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return float("nan")  # an empty cell, or a word

"""Takes screenshots of the studio in the Chromium of the end-to-end tests. Check the pictures by eye.

python tools/screenshots.py [--out FOLDER] [NAME ...]                  those of docs/images
python tools/screenshots.py --all-states --out FOLDER [NAME ...]       every state, light and dark, at four widths
"""

import argparse
import io
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import studio_states as do
from chromium import launch, on_the_bench
from PIL import Image
from playwright.sync_api import Browser, Page, expect, sync_playwright
from stage_states import gave
from studio_process import StudioProcess

ROOT = Path(__file__).resolve().parent.parent
LAPTOP, TABLET, PHONE = (1440, 900), (900, 1200), (390, 844)
SIZES = (1920, 1080), LAPTOP, (1024, 768), PHONE
ZOOMED = (720, 450)  # a laptop at a zoom of 200 %
SCROLLS = 1080  # px: below this width the page scrolls
TOUCHED = 1024  # px: up to this width, fingers are the usual pointer
STILL_MS = 1500  # until plots and view are drawn
COLOURS = 208  # of a picture; more are not seen, and cost a twentieth of its size
RESTS = """() => {
  const view = document.querySelector(".view canvas");
  return !view?.clientWidth || Math.abs(view.width - 2 * view.clientWidth) <= 2;
}"""  # drawn without a graphics card; without WebGL there is no view

# name, scene, action, size, colour scheme
STATES: tuple[tuple[str, str, do.Act, tuple[int, int], str], ...] = (
    ("stage", "venipuncture", gave, LAPTOP, "light"),
    ("stage-dark", "venipuncture", gave, LAPTOP, "dark"),
    ("stage-phone", "venipuncture", gave, PHONE, "light"),
    ("tour", "venipuncture", do.tour, LAPTOP, "light"),
    ("pop", "k06-fig10", do.popped, LAPTOP, "light"),
    ("again", "venipuncture", do.again, LAPTOP, "light"),
    ("vein", "venipuncture", do.popped, LAPTOP, "light"),
    ("editor", "k06-fig10", do.editor, LAPTOP, "light"),
    ("measured-tissue", "k06-fig10", do.measured_tissue, LAPTOP, "light"),
    ("error", "k06-fig10", do.wrong_value, LAPTOP, "light"),
    ("fault", "k06-fig10", do.fault, LAPTOP, "dark"),
    ("replay", "k06-fig12", do.replay, LAPTOP, "light"),
    ("result", "venipuncture", do.exercise, LAPTOP, "light"),
    ("estimate", "k06-fig10", do.estimate, LAPTOP, "light"),
    ("slice", "venipuncture", do.sliced, LAPTOP, "light"),
    ("epidural", "epidural", do.in_the_epidural, LAPTOP, "light"),
    ("projector", "epidural", do.projector, LAPTOP, "dark"),
    ("trace", "k06-fig10", do.identified, LAPTOP, "light"),
    ("trace-dark", "k06-fig10", do.identified, LAPTOP, "dark"),
    ("trace-phone", "k06-fig10", do.identified, PHONE, "light"),
    ("trace-phone-dark", "k06-fig10", do.identified, PHONE, "dark"),
    ("tablet", "venipuncture", do.popped, TABLET, "light"),
)

# What a person does after the window has its size.
AFTER = {"trace-phone": do.to_parameters, "trace-phone-dark": do.to_parameters}


@contextmanager
def opened(
    browser: Browser, scene: str, size: tuple[int, int], colours: str, touched: bool = False, bench: bool = True
) -> Iterator[Page]:
    """The page of a new studio."""
    with tempfile.TemporaryDirectory() as folder, StudioProcess(Path(folder), scene) as studio:
        viewport = {"width": size[0], "height": size[1]}
        context = browser.new_context(
            viewport=viewport, color_scheme=colours, reduced_motion="reduce", has_touch=touched
        )
        context.set_default_timeout(do.PATIENCE)
        if bench:
            on_the_bench(context)
        context.add_cookies([{"name": "punctura_sound", "value": "off", "url": studio.url}])
        page = context.new_page()
        page.goto(studio.url)
        yield page
        context.close()


def save(page: Page, path: Path) -> None:
    size = page.viewport_size
    assert size
    scrolls = size["width"] < SCROLLS and not page.get_by_role("dialog").count()  # a dialog covers what it scrolls
    page.wait_for_timeout(STILL_MS)
    rests = False
    while not rests:
        page.wait_for_function(RESTS)
        picture = scrolled(page, size["height"]) if scrolls else pictured(page)
        rests = page.evaluate(RESTS)  # it did not move meanwhile
    picture.quantize(COLOURS).save(path, optimize=True)
    print(path, flush=True)


def pictured(page: Page) -> Image.Image:
    """What the window shows. A picture of a whole page would have the style for a mouse, whatever the pointer is."""
    return Image.open(io.BytesIO(page.screenshot()))


def scrolled(page: Page, height: int) -> Image.Image:
    """The whole page, put together from pictures of the window."""
    whole = page.evaluate("document.documentElement.scrollHeight")
    pieces = []
    for top in range(0, whole, height):
        at = page.evaluate("top => { scrollTo(0, top); return scrollY; }", top)
        page.wait_for_timeout(STILL_MS / 5)
        pieces.append((round(at), pictured(page)))
    page.evaluate("scrollTo(0, 0)")
    picture = Image.new("RGB", (pieces[0][1].width, whole))
    for at, piece in pieces:
        picture.paste(piece, (0, at))
    return picture


def take(browser: Browser, out: Path, wanted: list[str]) -> None:
    for name, scene, act, size, colours in STATES:
        if wanted and name not in wanted:
            continue
        touched, stage = size[0] <= TOUCHED, name.startswith("stage")
        with opened(browser, scene, LAPTOP if touched else size, colours, touched, not stage) as page:
            act(page)
            page.set_viewport_size({"width": size[0], "height": size[1]})
            if name in AFTER:
                AFTER[name](page)
            save(page, out / f"studio-{name}.png")


def take_all(browser: Browser, out: Path, wanted: list[str]) -> None:
    """A state is reached once, in a wide window, and then shown at each size and in each scheme."""
    for name, scene, act in do.EVERY:
        if wanted and name not in wanted:
            continue
        stage = name.startswith("stage")
        with opened(browser, scene, LAPTOP, "light", bench=not stage) as page:
            act(page)
            tools = page.context.new_cdp_session(page)
            for width, height in (*SIZES, ZOOMED) if stage else SIZES:
                page.set_viewport_size({"width": width, "height": height})
                tools.send("Emulation.setTouchEmulationEnabled", {"enabled": width <= TOUCHED})
                touched = page.evaluate("matchMedia('(pointer: coarse)').matches")
                assert touched == (width <= TOUCHED), "the page does not have the style of its pointer"
                for colours in ("light", "dark"):
                    page.emulate_media(color_scheme=colours, reduced_motion="reduce")
                    save(page, out / f"{name}-{width}-{colours}.png")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "images")
    parser.add_argument("--all-states", action="store_true")
    parser.add_argument("names", nargs="*", metavar="NAME")
    arguments = parser.parse_args()
    known = {entry[0] for entry in (do.EVERY if arguments.all_states else STATES)}
    if wrong := sorted(set(arguments.names) - known):
        parser.error(f"unknown: {', '.join(wrong)}; known: {', '.join(sorted(known))}")
    arguments.out.mkdir(parents=True, exist_ok=True)
    os.environ.setdefault("PUNCTURA_LAB_NICE", "0")  # a computation of the Lab ends also on a busy computer
    expect.set_options(timeout=do.PATIENCE)
    with sync_playwright() as playwright:
        browser = launch(playwright)
        (take_all if arguments.all_states else take)(browser, arguments.out, arguments.names)
        browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""The page without a server in Chromium: the static folder behind a plain web server, as a person uses it.

    python -m pytest integrations/wasm/test_page.py --page FOLDER

FOLDER: made by tools/build_backend/static_page.py. Each wait is for something to be seen.
"""

import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import numpy as np
import punctura as pn
import pytest
from playwright.sync_api import Browser, Page, expect

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE.parents[1] / "tools"), str(HERE.parents[1] / "tests" / "page")]

from person import PATIENCE, drag_in, events, newton, opened, saved, tab, ticks_come  # noqa: E402

expect.set_options(timeout=PATIENCE)


class Files(SimpleHTTPRequestHandler):
    """A web server that knows nothing of Punctura."""

    def log_message(self, *_: object) -> None:
        pass


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """The address of a server of these files."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Files, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()


@pytest.fixture(scope="module")
def folder(request: pytest.FixtureRequest) -> Path:
    given = request.config.getoption("--page")
    assert given, "name the folder of the page: --page FOLDER"
    return Path(given)


@pytest.fixture(scope="module")
def page(folder: Path, browser: Browser) -> Iterator[Page]:
    """One page for all tests, in their order."""
    with served(folder) as url, opened(browser, url) as page:
        expect(page.locator(".connection-words")).to_have_text("Runs in this page")
        page.get_by_role("button", name="Skip").click()
        yield page


def choose(page: Page, title: str) -> None:
    page.locator(".scene-picker").select_option(label=title)
    expect(page.locator(".header")).to_contain_text("Force on")


def test_a_needle_that_is_dragged_in_pops_with_the_drop_of_the_law(page: Page) -> None:
    choose(page, "K06 Fig. 10")
    drag_in(page, pops=1)
    scene = pn.load_scene("k06-fig10")
    lower, _ = pn.ThickLaw(scene.needle, scene.membranes[0].membrane).bounds(np.linspace(0, 20e-3, 200_001))
    assert newton(events(page, "pop").first.inner_text()) == pytest.approx(-lower.min() + lower[-1], rel=0.02)


def test_what_needs_the_studio_says_so_and_has_no_button(page: Page) -> None:
    for name in ("Recordings", "Exercises", "Lab"):
        side = tab(page, name)
        panel = side.get_by_role("tabpanel", name=name)
        expect(panel.locator(".needs-studio")).to_contain_text("the studio, which this page does not have")
        assert panel.get_by_role("button").count() == 0, name
    expect(tab(page, "Health")).to_contain_text("A haptic device needs the studio")


def test_nothing_speaks_of_other_pages(page: Page) -> None:
    expect(page.get_by_text("You have control")).to_be_hidden()


def test_the_health_tells_the_rate_by_the_pages_clock_and_what_was_left_out(page: Page) -> None:
    health = tab(page, "Health").locator(".health-figures")
    expect(health).to_contain_text("of 1600 Hz")
    expect(health).to_contain_text("left out")
    expect(health.get_by_text("late ticks")).to_be_hidden()


def test_the_lab_estimates_while_the_run_goes_on(page: Page) -> None:
    lab = tab(page, "Lab")
    lab.get_by_label("Estimate", exact=True).check()
    expect(lab.locator(".estimate")).to_contain_text("Punctures found")
    lab.get_by_label("Estimate", exact=True).uncheck()
    expect(lab.locator(".estimate")).to_be_hidden()


def test_an_edit_takes_effect_and_a_wrong_value_is_told_at_its_field(page: Page) -> None:
    scene = tab(page, "Scene")
    friction = scene.get_by_role("textbox", name="Friction").first
    friction.fill("0.5")
    friction.press("Enter")
    expect(scene.get_by_role("button", name="Undo")).to_be_enabled()
    friction.fill("3.6")  # mu tan(theta) would be over 1, K06 (7)
    friction.press("Enter")
    expect(friction).to_have_attribute("aria-invalid", "true")
    scene.get_by_role("button", name="Reset").click()
    expect(friction).to_have_value("0.2")


def test_a_scene_is_saved_as_a_file_that_the_package_reads_and_loaded_again(page: Page, tmp_path: Path) -> None:
    scene = tab(page, "Scene")
    file = saved(page, scene.get_by_role("button", name="Save"), tmp_path)
    assert pn.load_scene(file) == pn.load_scene("k06-fig10")
    text = file.read_text(encoding="utf-8").replace("K06 Fig. 10", "Mine")
    for ending in ("", "\n[membrane"):
        page.set_input_files("input[type=file]", {"name": "a.toml", "mimeType": "", "buffer": (text + ending).encode()})
        if ending:
            expect(scene).to_contain_text("a.toml was not loaded; the run continues unchanged.")
            expect(scene).to_contain_text("This is not TOML")
        else:
            expect(page.locator(".scene-picker")).to_contain_text("Mine")
    ticks_come(page)


def test_a_fault_ends_the_force_until_it_is_turned_on(page: Page) -> None:
    tab(page, "Health").get_by_role("button", name="Try a fault").click()
    banner = page.locator(".panel.fault")
    expect(banner).to_contain_text("The device reported a number that is not finite")
    out = banner.get_by_role("button", name="Draw the needle out")
    if out.count():
        out.click()
    banner.get_by_role("button", name="Turn force on").click()
    expect(page.locator(".header")).to_contain_text("Force on")
    expect(banner).to_be_empty()


def test_force_off_and_on(page: Page) -> None:
    page.get_by_role("button", name="Turn force off").click()
    expect(page.locator(".header")).to_contain_text("Force off")
    page.get_by_role("button", name="Turn force on").click()
    expect(page.locator(".header")).to_contain_text("Force on")


def test_strokes_go_through_and_a_drag_ends_them(page: Page) -> None:
    choose(page, "K06 Fig. 12")
    hand = tab(page, "Hand")
    hand.get_by_label("Period").fill("1.5")
    hand.get_by_role("button", name="Start strokes").click()
    expect(events(page, "pop").nth(1)).to_be_attached()
    hand.get_by_role("button", name="Home").click()
    expect(hand.get_by_role("button", name="Start strokes")).to_be_visible()


def test_the_plunger_of_the_epidural_pushes(page: Page) -> None:
    choose(page, "Epidural")
    push = tab(page, "Hand").get_by_role("button", name="Hold to push")
    push.focus()
    page.keyboard.down("Enter")
    expect(push).to_have_attribute("aria-pressed", "true")
    ticks_come(page)
    page.keyboard.up("Enter")
    expect(push).to_have_attribute("aria-pressed", "false")


def test_the_examples_page_prints_the_forces_of_the_example(browser: Browser) -> None:
    with served(HERE) as url, opened(browser, f"{url}example.html") as page:
        expect(page.locator("#forces")).to_contain_text("8.0 mm")
        lines = page.locator("#forces").inner_text().splitlines()
        assert max(float(line.split()[2]) for line in lines if line.strip()) > 0.4

"""The epidural: the slice beside the 3-D view, the labels of the view, and the syringe."""

import io
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from person import columns, drag_in, opened, ready, saved, tab, ticks_come, view
from PIL import Image
from playwright.sync_api import Browser, Locator, Page, expect
from senses import STUBS
from studio_process import StudioProcess


@pytest.fixture(scope="module")
def epidural(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    folder: Path = tmp_path_factory.mktemp("studio")
    with StudioProcess(folder, "epidural") as running:
        yield running


@pytest.fixture(scope="module")
def shown(browser: Browser, epidural: StudioProcess) -> Iterator[Page]:
    with opened(browser, epidural.url, script=STUBS) as page:
        ready(page)
        yield page


APART = """() => {
  const [thumb, curve] = [".thumb-button", ".stage-curve"].map((at) => document.querySelector(at));
  const [a, b] = [thumb.getBoundingClientRect(), curve.getBoundingClientRect()];
  const row = document.querySelector(".stage-buttons button").getBoundingClientRect();
  return a.width >= 44 && a.height >= 44 && a.right <= innerWidth && a.top === row.top
    && b.width > 0 && (a.top >= b.bottom || a.bottom <= b.top);
}"""


def test_on_the_stage_of_a_phone_the_button_for_the_thumb_is_beside_the_others_and_covers_no_curve(
    shown: Page,
) -> None:
    shown.keyboard.press("Alt+b")
    shown.set_viewport_size({"width": 390, "height": 844})
    shown.wait_for_function(APART)
    shown.set_viewport_size({"width": 1440, "height": 900})
    shown.keyboard.press("Alt+b")
    expect(shown.locator(".view-main .thumb-button")).to_be_visible()


# Grey values of the slice's picture at a grid of places.
BRIGHTNESS = """() => {
    const canvas = document.querySelector(".slice canvas"), draw = canvas.getContext("2d");
    const at = (i, n, size) => Math.floor(((i + 0.5) / n) * size);
    return Array.from({length: 600}, (_, i) =>
        draw.getImageData(at(i % 20, 20, canvas.width), at(Math.floor(i / 20), 30, canvas.height), 1, 1).data[0]);
}"""


def test_the_slice_opens_shows_the_tissue_follows_the_probe_and_is_remembered(shown: Page) -> None:
    button = shown.locator(".view-main .view-tools").get_by_role("button", name="Slice", exact=True)
    assert shown.locator(".slice canvas").count() == 0, "a closed slice costs nothing"
    button.click()
    expect(button).to_have_attribute("aria-pressed", "true")
    picture = shown.get_by_role("application", name="Slice through the tissue")
    expect(picture).to_be_visible()
    expect(shown.locator(".slice")).to_contain_text("Drawing, not a simulation of an ultrasound instrument")
    expect(shown.locator(".slice-words")).to_contain_text("The needle is not in this slice")
    bright_and_dark = f"() => {{ const all = ({BRIGHTNESS})(); return Math.max(...all) - Math.min(...all) > 80; }}"
    shown.wait_for_function(bright_and_dark)
    before = shown.evaluate(BRIGHTNESS)

    picture.focus()
    for _ in range(6):
        shown.keyboard.press("ArrowDown")
    expect(shown.locator(".slice output").nth(1)).to_have_text("3.0 mm")
    shown.wait_for_function(f"before => String(({BRIGHTNESS})()) !== String(before)", arg=before)  # other speckle

    shown.reload()
    ready(shown)
    expect(picture).to_be_visible()
    shown.get_by_role("button", name="Close the slice").click()
    expect(picture).to_be_hidden()
    expect(button).to_be_focused()


def test_the_slice_says_where_the_needle_is(shown: Page) -> None:
    shown.locator(".view-main .view-tools").get_by_role("button", name="Slice", exact=True).click()
    drag_in(shown, pops=1)
    shown.get_by_role("button", name="Along needle").click()
    expect(shown.locator(".slice-words")).to_contain_text("The needle lies in the slice: the tip is")
    shown.get_by_role("button", name="Close the slice").click()


def turn_with_alt(page: Page, force: Locator) -> None:
    """Turns the wheel over the view with Alt until the thumb pushes. The needle must not move."""
    hand = page.get_by_role("row", name="Hand")
    box = view(page).bounding_box()
    assert box
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    before = hand.inner_text()
    page.keyboard.down("Alt")
    for _ in range(100):
        page.mouse.wheel(0, 100)
        ticks_come(page, 0.1)
        if force.inner_text()[0] in "123456789":
            break
    else:
        raise AssertionError("the thumb does not push")
    page.keyboard.up("Alt")
    assert hand.inner_text() == before


def test_a_key_a_trigger_and_the_wheel_push_the_plunger_and_its_force_is_in_plot_and_file(
    shown: Page, tmp_path: Path
) -> None:
    syringe = tab(shown, "Hand").locator("section", has=shown.get_by_role("heading", name="Syringe"))
    force = syringe.locator("output").first
    for press, release in (
        (lambda: shown.keyboard.down(" "), lambda: shown.keyboard.up(" ")),
        (lambda: shown.evaluate("pad.buttons[7].value = 0.5"), lambda: shown.evaluate("pad.buttons[7].value = 0")),
    ):
        view(shown).focus()
        press()
        expect(force).to_have_text(re.compile(r"^[1-9]"))
        release()
        expect(force).to_have_text(re.compile(r"^0[.][0-4]"))
    turn_with_alt(shown, force)
    expect(force).to_have_text(re.compile(r"^0[.][0-4]"))  # the thumb lets go when the wheel stops
    plot = shown.locator(".time-plots")
    plot.get_by_text("Curves").click()
    expect(plot.get_by_role("button", name="thumb, model force")).to_have_attribute("aria-pressed", "true")
    plot.get_by_text("Save").click()
    kept = columns(saved(shown, plot.get_by_role("button", name="CSV"), tmp_path))
    assert max(abs(newton) for newton in kept["thumb_force_N"]) > 1
    assert max(kept["injected_m3"]) > 0 and max(kept["plunger_m"]) > 0


def test_a_mouse_that_holds_the_plunger_moves_the_needle_with_its_wheel(shown: Page) -> None:
    force = tab(shown, "Hand").locator("section", has=shown.get_by_role("heading", name="Syringe")).locator("output")
    hand = shown.get_by_role("row", name="Hand")
    shown.get_by_role("button", name="Hold to push the plunger").hover()
    before = hand.inner_text()
    shown.mouse.wheel(0, 100)  # not held
    shown.mouse.down()
    expect(force.first).to_have_text(re.compile(r"^[1-9]"))
    expect(hand).to_have_text(before, use_inner_text=True)
    shown.mouse.wheel(0, 100)
    expect(hand).not_to_have_text(before, use_inner_text=True)
    shown.mouse.up()
    expect(force.first).to_have_text(re.compile(r"^0[.][0-4]"))


@pytest.fixture
def staged(shown: Page) -> Iterator[Page]:
    """The page on its stage; behind the test it is on the bench again."""
    stage = shown.get_by_role("button", name="Stage", exact=True)
    stage.click()
    yield shown
    shown.set_viewport_size({"width": 1440, "height": 900})
    shown.keyboard.press("Alt+b")
    expect(stage).to_be_visible()


def test_the_stage_tells_how_much_has_left_the_syringe(staged: Page) -> None:
    injected = staged.get_by_text("mL injected")
    expect(injected).to_have_text(re.compile(r"^\d+[.]\d mL"))
    before = injected.inner_text()
    view(staged).focus()
    staged.keyboard.down(" ")
    expect(injected).not_to_have_text(before)
    staged.keyboard.up(" ")


def fat_at_the_left_border(page: Page) -> bool:
    size = page.viewport_size
    assert size
    clip = {"x": 1, "y": 0, "width": 1, "height": size["height"]}
    column = Image.open(io.BytesIO(page.screenshot(clip=clip))).convert("RGB")
    return any(red > 200 and green > 150 and blue < 150 for _, (red, green, blue) in column.getcolors())


def test_the_tissue_goes_on_to_the_border_of_a_large_window_and_at_a_zoom_of_200_percent(staged: Page) -> None:
    for width, height in ((1920, 1080), (720, 450)):
        staged.set_viewport_size({"width": width, "height": height})
        for _ in range(100):
            staged.wait_for_timeout(100)
            if fat_at_the_left_border(staged):
                break
        else:
            raise AssertionError(f"the tissue ends before the border of {width} px")


def test_the_page_shows_a_second_device_under_the_thumb(browser: Browser, tmp_path: Path) -> None:
    second = ["--second-device", "simulated"]
    with StudioProcess(tmp_path, "epidural", more=second) as studio, opened(browser, studio.url) as page:
        ready(page)
        syringe = tab(page, "Hand").locator("section", has=page.get_by_role("heading", name="Syringe"))
        expect(syringe).to_contain_text("The second device pushes the plunger: PHANTOM Omni, simulated.")
        expect(syringe.get_by_role("button", name="Hold to push")).to_be_hidden()
        told = re.compile(r"second device\d+ of 1600 Hz, at most 3.3 N, 0.88 N rms in any 10 s")
        expect(tab(page, "Health")).to_contain_text(told)


OVERLAPS = """() => {
    const parts = ".view-label, .view-tools, .view-help, .view-coarser, .scale-bar, .hub-inset";
    const all = [...document.querySelectorAll(parts)]
        .filter(node => node.checkVisibility() && node.getBoundingClientRect().width > 0);
    const found = [];
    all.forEach((one, i) => all.slice(i + 1).forEach(other => {
        if (!one.matches(".view-label") && !other.matches(".view-label")) return;
        const a = one.getBoundingClientRect(), b = other.getBoundingClientRect();
        if (a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1)
            found.push(one.textContent + " / " + other.textContent);
    }));
    return found;
}"""


def test_no_label_covers_another_from_above_on_a_desktop_a_phone_and_at_200_percent(shown: Page) -> None:
    shown.locator(".view-main").get_by_role("button", name="Top", exact=True).click()
    for width, height in ((1440, 900), (390, 844), (720, 450)):
        shown.set_viewport_size({"width": width, "height": height})
        expect(shown.locator(".view-label.membrane:visible")).to_have_count(6)
        shown.wait_for_function(f"() => ({OVERLAPS})().length === 0", polling=100)


def test_the_exercise_of_the_plunger_says_that_a_key_feels_nothing(shown: Page) -> None:
    side = tab(shown, "Exercises")
    told = side.locator("article.exercise", has_text="The thumb is a key here and feels nothing")
    expect(told).to_have_count(1)
    expect(told).to_contain_text("Epidural with the plunger")

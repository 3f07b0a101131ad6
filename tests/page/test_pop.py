"""A person drags the needle through a membrane, and sees, hears and feels the pop."""

import re

import numpy as np
import punctura as pn
import pytest
from person import columns, drag_aside, drag_in, events, newton, opened, ready, saved, tab, ticks_come
from playwright.sync_api import expect
from senses import COUNT_RINGS, STUBS
from studio_process import PUNCTURA, StudioProcess

THROUGH = 3.9e-3  # m: K06 Fig. 10's tip is 3.76 mm long, its membrane 0.1 mm thick


@pytest.fixture
def quick(tmp_path, monkeypatch, browser):
    """A page with sound on and a gamepad, which gets its ticks and draws its pictures as often as a person's."""
    monkeypatch.setattr(StudioProcess, "program", PUNCTURA)
    with (
        StudioProcess(tmp_path, "k06-fig10") as studio,
        opened(browser, studio.url, sound="on", script=STUBS, fewer=False) as page,
    ):
        yield page


def laws_drop(scene):
    """What the law says that a straight push loses at the pop, N: its peak less the shaft's friction, K06 (18)."""
    law = pn.ThickLaw(scene.needle, scene.membranes[0].membrane)
    lower, _ = law.bounds(np.linspace(0, 20e-3, 200_001))
    return -lower.min() + lower[-1]


def test_a_needle_that_is_dragged_in_pops_and_the_plots_show_the_drop_of_the_law(quick, tmp_path):
    page = quick
    expect(page.locator(".header")).to_contain_text("Force on")  # the drag is the first thing that a person does
    page.evaluate(COUNT_RINGS)
    drag_in(page, pops=1, step=6)
    told = newton(events(page, "pop").first.inner_text())
    expected = laws_drop(pn.load_scene("k06-fig10"))
    assert told == pytest.approx(expected, rel=0.02)

    page.wait_for_function("rings === 1")
    assert newton(page.locator(".pop-callout").inner_text()) == told
    assert page.evaluate("heard") == ["friction", "click", "thump"]
    ((kind, effect),) = page.evaluate("rumbled")
    assert kind == "dual-rumble" and effect["strongMagnitude"] == pytest.approx(min(1, 0.3 + 2 * told), abs=0.02)

    panel = page.locator(".force-depth")
    panel.get_by_text("Save").click()
    plotted = columns(saved(page, panel.get_by_role("button", name="CSV"), tmp_path))
    depth, force = plotted["depth_0_m"], np.abs(plotted["force_0_N"])
    through = np.array(depth) > THROUGH
    assert through.any() and (~through).any()
    assert np.nanmax(force[~through]) - np.nanmax(force[through]) == pytest.approx(expected, rel=0.02)
    assert (np.diff(plotted["tick"]) == 1).all(), "every tick is in the plot"


def test_a_drag_moves_the_needle_to_the_side_only_with_its_key_or_button(page):
    def aside() -> float:  # m
        return 1e-3 * float(x.inner_text().replace("\N{MINUS SIGN}", "-"))

    def aside_at_rest(beyond: float = -np.inf, below: float = np.inf) -> float:
        """Where the hand comes to rest. It follows late when the computer is busy: it waits for the range."""
        before, now = np.inf, aside()
        for _ in range(100):
            if abs(now - before) < 1.5e-5 and beyond < now < below:
                return now
            ticks_come(page, 0.5)
            before, now = now, aside()
        raise AssertionError(f"the hand is at {now} m, not between {beyond} and {below}")

    ready(page)
    x = tab(page, "Hand").locator(".place").get_by_role("row", name="Tip").get_by_role("cell").first
    expect(x).to_have_text(re.compile(r"\d"))
    start = aside()
    drag_aside(page, 80)
    assert aside_at_rest() == pytest.approx(start, abs=1e-4)
    page.keyboard.down("Shift")
    drag_aside(page, 80)
    page.keyboard.up("Shift")
    with_key = aside_at_rest(beyond=start + 1e-3)
    page.get_by_role("button", name="Sideways").click()
    drag_aside(page, -80)
    aside_at_rest(below=with_key - 1e-3)


def test_the_phase_is_told_in_words_and_fits_a_phone(page):
    ready(page)
    expect(page.locator(".phases")).to_contain_text("outside")
    expect(page.locator(".phases thead")).to_contain_text("model force, N")
    drag_in(page, pops=1)
    expect(page.locator(".phases")).to_contain_text("through")
    # A slow push may end at the edge of the band, where the needle still slides.
    expect(page.locator(".phases")).to_contain_text(re.compile("at rest|going in"))
    page.locator(".pop-callout button").click()
    expect(page.get_by_role("button", name="Back to live")).to_be_visible()
    page.keyboard.press("Escape")
    expect(page.get_by_role("button", name="Back to live")).to_have_count(0)
    page.set_viewport_size({"width": 390, "height": 844})
    assert page.evaluate("document.documentElement.scrollWidth") <= 390, "on a phone, a part is beside the screen"

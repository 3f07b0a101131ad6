"""A limit that cuts the force is seen where the force is; after a fault, one sentence and one button are."""

from pathlib import Path

import punctura as pn
import pytest
from person import columns, drag_in, opened, ready, saved, tab, view
from playwright.sync_api import Browser, expect
from punctura._core import ForceLimits, force_scale
from punctura.live import felt_force
from studio_process import StudioProcess


@pytest.fixture
def limits(tmp_path: Path) -> Path:
    file = tmp_path / "limits.toml"
    file.write_text("continuous_force_N = 0.1\ncontinuous_time_s = 2\n")
    return file


def test_the_header_names_the_limit_that_cuts_the_force(browser: Browser, tmp_path: Path, limits: Path):
    more = ["--limits", str(limits)]
    with StudioProcess(tmp_path, "k06-fig10", more=more) as studio, opened(browser, studio.url) as page:
        ready(page)
        tab(page, "Hand").get_by_role("button", name="Start strokes").click()
        state = page.locator(".header .servo-state")
        expect(state).to_contain_text("Force cut: long-run limit")
        expect(state.locator(".figures")).to_contain_text(" N")
        loop = tab(page, "Health").locator(".health-limits")
        expect(loop).to_contain_text("peak force3.3 N")
        expect(loop).to_contain_text("long-run force0.1 N rms in any 2 s")
        expect(loop).to_contain_text("speed of the hand8 m/s")


def test_the_stage_tells_a_cut_force_with_what_to_do_also_without_a_device(
    browser: Browser, tmp_path: Path, limits: Path
):
    with (
        StudioProcess(tmp_path, "k06-fig10", more=["--limits", str(limits)]) as studio,
        opened(browser, studio.url, bench=False) as page,
    ):
        cut = page.locator(".stage-cut")
        expect(page.locator(".stage-number")).to_contain_text("N")
        expect(cut).to_be_empty()
        view(page).focus()
        for _ in range(100):
            page.keyboard.press("ArrowDown")
            page.wait_for_timeout(50)
            if cut.inner_text():
                break
        expect(cut).to_contain_text("Force cut: long-run limit, 0.")
        expect(cut).to_contain_text("Draw back a little")
        page.set_viewport_size({"width": 390, "height": 844})
        box = cut.bounding_box()
        assert box and box["width"] > 260 and box["height"] < 80  # some lines, and no column of single words


def test_the_scale_stands_where_a_force_is_and_a_loss_that_cannot_be_felt_is_told_before_the_start(
    browser: Browser, tmp_path: Path
):
    weak = ForceLimits(max_force=0.1)
    felt = felt_force(force_scale(pn.load_scene("epidural"), weak)).replace("(x ", "(\u00d7 ")
    more = ["--max-force-N", "0.1"]
    with StudioProcess(tmp_path, "epidural", more=more) as studio, opened(browser, studio.url) as page:
        ready(page)
        expect(page.locator(".phases thead")).to_contain_text(f"{felt}, N")
        for plot in (".force-depth", ".time-plots"):
            expect(page.locator(f"{plot} .force-scale")).to_have_text(felt)
        name = page.get_by_text("Epidural", exact=True)
        card = tab(page, "Exercises").locator("article").filter(has=name)
        expect(card).to_contain_text("This device cannot show the loss of resistance of the ligamentum flavum")
        expect(card).to_contain_text("N; 0.1 N needed), so an attempt cannot be passed here.")


def test_after_a_fault_one_button_leads_out_of_it_and_the_sentence_says_what_is_missing(page, tmp_path):
    ready(page)
    drag_in(page, pops=1)
    tab(page, "Health")
    page.get_by_role("button", name="Try a fault").click()
    banner = page.locator(".fault")
    expect(banner).to_contain_text("The device reported a number that is not finite")
    expect(banner).to_contain_text("draw the needle out of the tissue and press “Turn force on”")
    expect(page.locator(".header")).to_contain_text("Fault")
    expect(page.locator(".header").get_by_role("button", name="Turn force")).to_have_count(0)
    expect(page.locator(".health-figures")).to_contain_text("Fault: no force")

    kept = columns(saved(page, banner.get_by_role("link", name="Save the 1 000 ticks"), tmp_path))
    assert len(kept["tick"]) == 1000 and kept["depth_0_m"][0] > 0

    banner.get_by_role("button", name="Draw the needle out").click()
    banner.get_by_role("button", name="Turn force on").click()
    expect(banner).to_be_empty()
    expect(page.locator(".header")).to_contain_text("Force on")
    expect(page.locator(".side").get_by_role("link", name="Save the 1 000 ticks")).to_be_visible()

"""A limit that cuts the force is seen where the force is."""

from pathlib import Path

import punctura as pn
import pytest
from person import opened, ready, tab
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

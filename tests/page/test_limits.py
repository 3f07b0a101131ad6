"""A limit that cuts the force is seen where the force is."""

from pathlib import Path

import pytest
from person import PATIENCE, ready, tab
from playwright.sync_api import Browser, expect
from studio_process import StudioProcess


@pytest.fixture
def limits(tmp_path: Path) -> Path:
    file = tmp_path / "limits.toml"
    file.write_text("continuous_force_N = 0.1\ncontinuous_time_s = 2\n")
    return file


def test_the_header_names_the_limit_that_cuts_the_force(browser: Browser, tmp_path: Path, limits: Path):
    with StudioProcess(tmp_path, "k06-fig10", more=["--limits", str(limits)]) as studio:
        page = browser.new_context(viewport={"width": 1440, "height": 900}, reduced_motion="reduce").new_page()
        page.goto(studio.url, timeout=120_000)
        ready(page)
        tab(page, "Hand").get_by_role("button", name="Start strokes").click()
        state = page.locator(".servo-state")
        expect(state).to_contain_text("Force cut: long-run limit", timeout=PATIENCE)
        expect(state.locator(".figures")).to_contain_text(" N", timeout=PATIENCE)
        loop = tab(page, "Health").locator(".health-limits")
        expect(loop).to_contain_text("peak force3.3 N")
        expect(loop).to_contain_text("long-run force0.1 N rms in any 2 s")
        expect(loop).to_contain_text("speed of the hand8 m/s")
        page.context.close()

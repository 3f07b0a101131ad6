"""Someone tunes a membrane while it runs."""

import re

import pytest
from person import opened, ready, tab
from playwright.sync_api import expect
from punctura.scene import scene_path
from studio_process import StudioProcess


@pytest.fixture(scope="module")
def page(browser, tmp_path_factory):
    """One page for all, with the tab of the scene."""
    folder = tmp_path_factory.mktemp("studio")
    with StudioProcess(folder, "k06-fig10") as studio, opened(browser, studio.url) as page:
        ready(page)
        tab(page, "Scene")
        yield page


def law_text(page):
    return page.locator(".side svg path").evaluate_all("paths => paths.map(p => p.getAttribute('d')).join()")


def test_a_changed_parameter_changes_the_law_and_the_force_stays_on(page):
    before = law_text(page)
    stiffness = page.get_by_role("textbox", name="Stiffness").first
    stiffness.fill("1.4")
    stiffness.press("Enter")
    page.wait_for_function(
        "before => [...document.querySelectorAll('.side svg path')].map(p => p.getAttribute('d')).join() !== before",
        arg=before,
    )
    expect(page.locator(".header")).to_contain_text("Force on")


def test_a_value_out_of_bounds_is_told_at_its_field_and_changes_nothing(page):
    friction = page.get_by_role("textbox", name="Friction").first
    friction.fill("3.6")  # mu tan(theta) would be over 1, K06 (7)
    friction.press("Enter")
    expect(friction).to_have_attribute("aria-invalid", "true")
    expect(page.locator(".side")).to_contain_text("The largest value that is allowed")
    expect(page.locator(".header")).to_contain_text("Force on")


def test_the_other_solver_is_one_click_away(page):
    page.get_by_role("radio", name="Paper").or_(page.get_by_role("button", name="Paper")).first.click()
    page.get_by_text("Compare with the other solver").click()
    expect(page.locator(".force-depth")).to_contain_text("solver")


def test_a_wrong_scene_file_is_refused_without_the_names_of_its_keys(page, tmp_path):
    file = tmp_path / "wrong.toml"
    text = scene_path("k06-fig10").read_text(encoding="utf-8")
    file.write_text(re.sub("stiffness_N_per_mm = [0-9.]+\n", "stiffness_N_per_mm = -1\n", text), encoding="utf-8")
    page.get_by_label("Scene file").set_input_files(file)
    side = page.locator(".side")
    expect(side).to_contain_text("wrong.toml was not loaded; the run continues unchanged.")
    expect(side).to_contain_text("membrane 1, stiffness = -1: ")
    expect(side).not_to_contain_text("_N_per_mm")

"""The laboratory, the legends, and one moment in view, plots and tables."""

import zipfile

import pytest
import tomllib
from person import ready, saved, tab
from playwright.sync_api import expect


def test_a_parameter_is_varied_and_saved_and_the_moment_and_the_curves_are_chosen(page, tmp_path):
    ready(page)
    page.locator(".time-plots").get_by_text("Curves").click()
    limit = page.locator(".time-plots").get_by_role("button", name="force limit")
    expect(limit).to_have_attribute("aria-pressed", "false")
    limit.click()
    page.locator(".force-depth").get_by_text("Curves").click()
    depth = page.locator(".force-depth").get_by_role("button", name="force limit")
    expect(depth).to_have_attribute("aria-pressed", "true")

    tab(page, "Lab").get_by_role("button", name="Simulate").click()
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("row", name="mean")).to_contain_text("±")
    bundle = zipfile.ZipFile(saved(page, dialog.get_by_role("button", name="Save everything"), tmp_path))
    assert {"figure.svg", "figure.pdf", "curves.parquet", "CITATION.cff", "scenes/05.toml"} <= set(bundle.namelist())
    stiffness = [tomllib.loads(bundle.read(f"scenes/0{run}.toml").decode())["membrane"][0] for run in (1, 5)]
    assert 3 * stiffness[0]["stiffness_N_per_mm"] == pytest.approx(stiffness[1]["stiffness_N_per_mm"])
    assert bundle.read("statistics.csv").count(b"\n") == 6
    dialog.get_by_role("button", name="Show in the plots").click()
    dialog.get_by_role("button", name="Close", exact=True).click()
    expect(page.locator(".time-plots .plot-legend")).to_contain_text("n = 5")

    page.locator(".time-plots canvas").hover()
    expect(page.locator(".view-moment")).to_be_visible()
    pause = page.locator(".time-plots").get_by_role("button", name="Pause")
    pause.click()
    expect(page.locator(".player")).to_contain_text("the run goes on")
    page.locator(".time-plots canvas").focus()
    page.keyboard.press("ArrowLeft")
    said = page.locator(".time-plots .only-read").inner_text()
    shown = "Math.abs(parseFloat(document.querySelector('.phases-when').textContent) - at)"
    page.wait_for_function(f"at => {shown} < 1.5e-3", arg=float(said.split()[0]))  # both are rounded to ms


def test_a_second_comparison_waits_in_line_and_one_too_many_is_refused_with_a_sentence(page):
    ready(page)
    lab = tab(page, "Lab")
    held = []
    page.route("**/api/lab/compare*", lambda route: held.append(route))
    for _ in range(4):
        lab.get_by_role("button", name="Simulate").click()
    expect(lab.get_by_role("alert").filter(has_text="3 computations are in line")).to_be_visible()
    rows = lab.locator(".progress:visible")
    expect(rows).to_have_count(3)
    rows.nth(1).get_by_role("button", name="Cancel").click()
    expect(rows).to_have_count(2)
    for route in (held[0], held[2]):
        route.continue_()
    expect(page.locator("dialog.lab-result")).to_have_count(2)
    expect(rows).to_have_count(0)

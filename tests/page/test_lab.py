"""The laboratory, the legends, and one moment in view, plots and tables."""

from person import ready, tab
from playwright.sync_api import expect


def test_a_parameter_is_varied_and_the_moment_and_the_curves_are_chosen(page):
    ready(page)
    permitted = page.locator(".time-plots").get_by_role("button", name="permitted force")
    expect(permitted).to_have_attribute("aria-pressed", "false")
    permitted.click()
    depth = page.locator(".force-depth").get_by_role("button", name="permitted force")
    expect(depth).to_have_attribute("aria-pressed", "true")

    tab(page, "Lab").get_by_role("button", name="Simulate").click()
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("row", name="mean")).to_contain_text("±")
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

"""Someone tunes a membrane while it runs."""

from person import ready, tab
from playwright.sync_api import expect


def law_text(page):
    return page.locator(".side svg path").evaluate_all("paths => paths.map(p => p.getAttribute('d')).join()")


def test_a_changed_parameter_changes_the_law_and_the_force_stays_on(page):
    ready(page)
    tab(page, "Scene")
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
    ready(page)
    tab(page, "Scene")
    friction = page.get_by_role("textbox", name="Friction").first
    friction.fill("3.6")  # mu tan(theta) would be over 1, K06 (7)
    friction.press("Enter")
    expect(friction).to_have_attribute("aria-invalid", "true")
    expect(page.locator(".side")).to_contain_text("The largest value that is allowed")
    expect(page.locator(".header")).to_contain_text("Force on")


def test_the_other_solver_is_one_click_away(page):
    ready(page)
    tab(page, "Scene")
    page.get_by_role("radio", name="Paper").or_(page.get_by_role("button", name="Paper")).first.click()
    page.get_by_text("Compare with the other solver").click()
    expect(page.locator(".force-depth")).to_contain_text("solver")

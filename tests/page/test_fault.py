"""A fault ends the force, shows its reason, and is cleared by a reset."""

from person import PATIENCE, ready, tab
from playwright.sync_api import expect


def test_a_fault_shows_its_reason_and_reset_clears_it(page):
    ready(page)
    tab(page, "Loop")
    page.get_by_role("button", name="Try a fault").click()
    banner = page.get_by_role("alert", name="Fault").or_(page.locator(".fault"))
    expect(banner.first).to_contain_text("no force", timeout=PATIENCE)
    expect(page.locator(".header")).to_contain_text("Fault")
    page.get_by_role("button", name="Reset", exact=True).first.click()
    expect(page.locator(".fault")).to_be_empty(timeout=PATIENCE)
    page.get_by_role("button", name="Turn force on").click()
    expect(page.locator(".header")).to_contain_text("Force on", timeout=PATIENCE)

"""After a fault: one sentence, one button, and the ticks before it as a file."""

from person import columns, drag_in, ready, saved, tab
from playwright.sync_api import expect


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

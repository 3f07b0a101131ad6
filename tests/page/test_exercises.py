"""The venipuncture exercise, to success and to failure."""

from person import PATIENCE, push, ready, tab
from playwright.sync_api import expect


def begin(page):
    ready(page)
    tab(page, "Exercises")
    page.get_by_role("textbox").first.fill("Ann")
    card = page.locator("article.exercise", has_text="Venipuncture")
    card.get_by_role("button", name="Start").click()
    expect(page.locator(".running")).to_be_visible(timeout=PATIENCE)
    expect(page.locator(".header")).to_contain_text("Force on", timeout=PATIENCE)


def test_going_through_the_back_wall_is_told(page):
    begin(page)
    for _ in range(60):
        push(page, "Shift+ArrowDown", 5)
        if page.get_by_role("dialog").count():
            break
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("not passed", timeout=PATIENCE)
    expect(dialog).to_contain_text("back")
    expect(dialog).to_contain_text("Peak force")


def test_staying_in_the_vein_passes(page):
    begin(page)
    running = page.locator(".running")
    for _ in range(200):
        push(page, "ArrowDown", 1)
        page.wait_for_timeout(60)
        if "hold" in running.inner_text().lower() and page.locator(".events-list .event.pop").count() >= 2:
            break
    expect(page.get_by_role("dialog")).to_contain_text("passed", timeout=PATIENCE)
    expect(page.get_by_role("dialog")).not_to_contain_text("not passed")

"""An exercise that is made in the page: saved, listed, tried."""

from person import ready, tab
from playwright.sync_api import expect


def test_an_exercise_is_made_saved_and_tried_under_its_title(page):
    ready(page)
    side = tab(page, "Exercises")
    side.get_by_text("Make an exercise", exact=True).click()
    side.get_by_label("Title").fill("My own goal")
    side.get_by_role("button", name="Save on this computer").click()
    expect(side).to_contain_text("saved in ")
    expect(page.locator("article.exercise", has_text="My own goal")).to_be_visible()
    side.get_by_role("button", name="Try", exact=True).click()
    running = page.locator(".running")
    expect(running).to_contain_text("My own goal")
    running.get_by_role("button", name="End").click()
    expect(running).to_be_hidden()

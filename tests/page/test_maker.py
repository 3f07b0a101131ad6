"""An exercise that is made in the page: saved, listed, tried."""

from pathlib import Path

import tomllib
from person import ready, tab
from playwright.sync_api import expect


def test_an_exercise_is_made_saved_and_tried_under_its_title(page):
    ready(page)
    side = tab(page, "Exercises")
    side.get_by_text("Make an exercise", exact=True).click()
    side.get_by_label("Title").fill("My own goal")
    edge = side.get_by_role("slider", name="Lower edge of the goal")
    before = float(edge.get_attribute("aria-valuenow"))
    edge.hover()
    page.mouse.down()
    box = edge.bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2 - 30, steps=3)
    page.mouse.up()
    after = float(edge.get_attribute("aria-valuenow"))
    assert after < before - 1
    expect(side.get_by_label("Lower edge, mm")).to_have_value(f"{after:g}")
    side.get_by_role("button", name="Save on this computer").click()
    note = side.locator(".maker-note")
    expect(note).to_contain_text("saved in ")
    file = Path(note.inner_text().split("saved in ")[1])
    assert tomllib.loads(file.read_text(encoding="utf-8"))["space"]["deepest_mm"] == after
    expect(page.locator("article.exercise", has_text="My own goal")).to_be_visible()
    side.get_by_role("button", name="Try", exact=True).click()
    running = page.locator(".running")
    expect(running).to_contain_text("My own goal")
    running.get_by_role("button", name="End").click()
    expect(running).to_be_hidden()


def test_a_scene_with_a_syringe_offers_the_goals_of_the_plunger(page):
    ready(page)
    side = tab(page, "Exercises")
    side.get_by_text("Make an exercise", exact=True).click()
    plunger = side.get_by_label("Push the plunger until it gives way, N at least")
    expect(side.get_by_label("Goal behind the membrane")).to_be_visible()
    expect(plunger).to_have_count(0)
    side.get_by_role("combobox", name="Scene", exact=True).select_option("Epidural")
    plunger.fill("20")
    plunger.press("Tab")
    expect(side.locator("#maker-push-problem")).to_have_text("must be at most 15 N")
    plunger.fill("2")
    side.get_by_label("In the 1 s after it, inject at most, mL").fill("1.5")
    side.get_by_role("button", name="Try", exact=True).click()
    running = page.locator(".running")
    expect(running).to_contain_text("Feel the plunger give way: push it with at least 2 N through the")
    expect(running).to_contain_text("Inject no more than 1.5 mL in the 1 s after the plunger gives way")
    running.get_by_role("button", name="End").click()
    expect(running).to_be_hidden()

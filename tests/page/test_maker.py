"""An exercise that is made in the page: saved, listed, tried, and opened from a file."""

from pathlib import Path

import tomllib
from person import opened, ready, saved, tab
from playwright.sync_api import expect
from punctura.exercise import load_exercise
from punctura.scene import scene_path


def test_an_exercise_is_made_saved_and_tried_under_its_title(page):
    ready(page)
    side = tab(page, "Exercises")
    side.get_by_text("Make an exercise", exact=True).click()
    side.get_by_label("Title").fill("My own goal")
    task = side.get_by_label("Instruction")
    expect(task).to_have_value("Push in until the thin membrane gives way, and stop.")
    assert task.evaluate("e => e.scrollHeight <= e.clientHeight && e.scrollWidth <= e.clientWidth")  # all is readable
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
    expect(side.locator("[id='maker-goal.feel_plunger-problem']")).to_have_text("Must be at most 15 N.")
    plunger.fill("2")
    side.get_by_label("In the 1 s after the plunger gives way, inject at most, mL").fill("1.5")
    side.get_by_role("button", name="Try", exact=True).click()
    running = page.locator(".running")
    expect(running).to_contain_text("Feel the plunger give way: push it with at least 2 N through the")
    expect(running).to_contain_text("Inject no more than 1.5 mL in the 1 s after the plunger gives way")
    running.get_by_role("button", name="End").click()
    expect(running).to_be_hidden()


def drop(page, name, text):
    """Drops a file on the page."""
    page.evaluate(
        """([name, text]) => {
            const data = new DataTransfer();
            data.items.add(new File([text], name));
            document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
        }""",
        [name, text],
    )


def test_a_downloaded_exercise_is_opened_after_a_reload_and_runs(page, tmp_path):
    ready(page)
    side = tab(page, "Exercises")
    side.get_by_text("Make an exercise", exact=True).click()
    side.get_by_label("Title").fill("From another desk")
    side.get_by_label("Title").press("Tab")
    file = saved(page, side.get_by_role("button", name="Download file"), tmp_path)
    assert file.name == "from-another-desk.toml"

    page.reload()
    ready(page)
    side = tab(page, "Exercises")
    card = page.locator("article.exercise", has_text="From another desk")
    expect(card).to_have_count(0)
    side.get_by_label("Exercise file").set_input_files(file)
    expect(side.get_by_text("from-another-desk.toml is in the list.")).to_be_visible()
    expect(card.get_by_role("button", name="Start")).to_be_focused()

    side.get_by_label("Exercise file").set_input_files(file)
    problems = side.locator(".open-exercise [role=alert]")
    expect(problems).to_contain_text("there is an exercise from-another-desk already")
    file.write_text(file.read_text(encoding="utf-8").replace("From another desk", "Corrected"), encoding="utf-8")
    side.get_by_role("button", name="Replace from-another-desk").click()
    expect(problems).to_contain_text("cannot be read")  # it has changed since it was chosen
    drop(page, file.name, file.read_text(encoding="utf-8"))
    side.get_by_role("button", name="Replace from-another-desk").click()
    card = page.locator("article.exercise", has_text="Corrected")
    card.get_by_role("button", name="Start").click()
    running = page.locator(".running")
    expect(running).to_contain_text("Corrected")
    running.get_by_role("button", name="End").click()
    expect(running).to_be_hidden()


def test_a_wrong_file_is_told_with_its_places_and_a_looker_on_is_told_why(page, studio, browser):
    ready(page)
    tab(page, "Hand")
    text = load_exercise("venipuncture").path.read_text(encoding="utf-8")
    drop(page, "mine.toml", text.replace("seconds = 3\n", "seconds = -3\n").replace('"front vein wall"', '"wall"'))
    problems = page.locator(".open-exercise [role=alert]")
    expect(problems).to_contain_text("mine.toml was not opened:")  # the tab has opened
    expect(problems).to_be_in_viewport()
    expect(problems).to_contain_text("seconds = -3: Must be at least 0.01 s.")
    expect(problems).to_contain_text("space.behind = 'wall': Must be one of the scene's membranes: skin,")
    drop(page, "scene.toml", scene_path("venipuncture").read_text(encoding="utf-8"))
    expect(problems).to_contain_text("Is a scene file, not an exercise file")
    drop(page, "long.toml", "#" * 64_001)
    expect(problems).to_contain_text("is larger than 64 kB")
    drop(page, "mine.toml", text)
    expect(problems).to_be_hidden()
    expect(page.locator("[data-exercise=mine]")).to_be_visible()

    with opened(browser, studio.url) as second:
        expect(second.locator(".connection-words")).to_have_text("Connected")
        if second.get_by_role("button", name="Skip").count():
            second.get_by_role("button", name="Skip").click()
        drop(second, "other.toml", text)
        expect(second.locator(".open-exercise [role=alert]")).to_contain_text("other.toml was not opened. ")
        expect(second.get_by_role("button", name="Open an exercise file…")).to_be_disabled()
        expect(second.locator("[data-exercise=mine]")).to_be_visible()
        expect(second.locator("[data-exercise=other]")).to_have_count(0)
        drop(page, "later.toml", text)
        expect(page.locator("[data-exercise=later]")).to_be_visible()
        tab(second, "Exercises").get_by_role("button", name="Take control").click()
        expect(second.locator("[data-exercise=later]")).to_be_visible()

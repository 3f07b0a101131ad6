"""An exercise that is made in the page: saved, listed, tried, and opened from a file."""

import re

import tomllib
from person import opened, push, ready, saved, tab
from playwright.sync_api import expect
from punctura.exercise import load_exercise
from punctura.scene import scene_path


def test_an_exercise_is_made_saved_and_tried_under_its_title(page, studio):
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
    expect(note).to_have_text("“My own goal” is in the list.")  # and no path, which says nothing to a teacher
    (file,) = (studio.recordings / "exercises").glob("*.toml")
    assert tomllib.loads(file.read_text(encoding="utf-8"))["space"]["deepest_mm"] == after
    expect(page.locator("article.exercise", has_text="My own goal")).to_be_visible()
    side.get_by_role("button", name="Try", exact=True).click()
    running = page.locator(".running")
    expect(running).to_contain_text("My own goal")
    push(page, "Shift+ArrowDown", 8)
    running.get_by_role("button", name="End").click()
    result = page.get_by_role("dialog")
    expect(result.get_by_role("heading", level=2)).to_have_text("My own goal (draft) ✕ not passed")
    expect(result).to_contain_text("What went well")
    expect(result).to_contain_text("is not kept")
    expect(result.locator(".trace svg")).to_be_visible()
    expect(result.get_by_role("button", name=re.compile("^Use as expert"))).to_have_count(0)
    result.get_by_role("button", name="Try again").click()
    expect(running).to_contain_text("My own goal")
    running.get_by_role("button", name="End").click()
    expect(running).to_be_hidden()


def test_whoever_comes_from_the_stage_tries_a_made_exercise_there(browser, studio):
    with opened(browser, studio.url, bench=False) as page:
        page.get_by_role("button", name="More").click()
        ready(page)
        side = tab(page, "Exercises")
        side.get_by_text("Make an exercise", exact=True).click()
        side.get_by_role("button", name="Try", exact=True).click()
        expect(page.locator(".stage-sentence")).to_have_text("Push in until the thin membrane gives way, and stop.")


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


# Of each kind of goal: its scene, a wrong value and what is said of it, a right value, and the goal's sentence.
GOALS = {
    "stay": ("Venipuncture", "0", "at least 0.01 s", "2", "Hold the whole tip in the vessel for 2 s"),
    "never_pass": ("Venipuncture", None, "", "back vein wall", "Do not go through the back vein wall"),
    "stop_after_pop": ("Venipuncture", "0", "at least 0.1 mm", "2", "Run no more than 2 mm past the front vein wall"),
    "straight": ("Venipuncture", "0", "at least 0.1 mm", "0.5", "Stay within 0.5 mm of the line of entry"),
    "peak_force": ("Venipuncture", "0", "at least 0.001 N", "0.5", "Push with no more than 0.5 N"),
    "speed": ("Venipuncture", "0.1", "at least 0.5 mm/s", "5", "Push in with no more than 5 mm/s"),
    "entry_angle": ("Venipuncture", "0", "at least 1 degree.", "7", "Enter the skin at 30 degrees, within 7 degrees"),
    "no_pause": ("Venipuncture", "0", "at least 0.01 s", "1", "Do not stand still for 1 s on the way to the vessel"),
    "depth": ("Venipuncture", "0", "at least 0.1 mm", "2.5", "Keep the point within 2.5 mm of the front vein wall"),
    "time_limit": ("Venipuncture", "0", "at least 0.01 s", "60", "Finish within 60 s of the first contact"),
    "entries": ("Venipuncture", "1.5", "a whole number", "1", "Enter the skin no more than once"),
    "feel_plunger": ("Epidural", "20", "at most 15 N", "2", "Feel the plunger give way: push it with at least 2 N"),
    "stop_plunger": ("Epidural", "0", "at least 0.01 mL", "1.5", "Inject no more than 1.5 mL in the 1 s after"),
}


def test_each_kind_of_goal_has_its_field_its_problem_and_its_sentence(page):
    ready(page)
    side = tab(page, "Exercises")
    side.get_by_text("Make an exercise", exact=True).click()
    fields = side.locator(".maker :is(input, select)[id^='maker-goal.']")
    scene = side.get_by_role("combobox", name="Scene", exact=True)
    for name in ("Venipuncture", "Epidural"):
        scene.select_option(name)
        asked = {field.removeprefix("maker-goal.") for field in fields.evaluate_all("all => all.map(({id}) => id)")}
        assert asked == {kind for kind, (where, *_) in GOALS.items() if where == name or name == "Epidural"}
    for kind, (where, wrong, reason, right, sentence) in GOALS.items():
        scene.select_option("Epidural" if where == "Venipuncture" else "Venipuncture")  # forgets the goals before
        scene.select_option(where)
        field = side.locator(f"[id='maker-goal.{kind}']")
        side.get_by_label("Title").fill(f"Only {kind}")
        for other in ("stay", "entries", "time_limit"):  # of a new exercise
            side.locator(f"[id='maker-goal.{other}']").fill("")
            side.locator(f"[id='maker-goal.{other}']").press("Tab")
        if wrong is None:
            field.select_option(right)
        else:
            field.fill(wrong)
            field.press("Tab")
            expect(side.locator(f"[id='maker-goal.{kind}-problem']")).to_contain_text(f"Must be {reason}")
            field.fill(right)
            field.press("Tab")
        task = side.get_by_label("Instruction")
        expect(task).to_have_value(re.compile("plunger" if "plunger" in kind else "^Push in at 30 degrees until the"))
        side.get_by_role("button", name="Save on this computer").click()
        goals = page.locator(f"[data-exercise='only-{kind.replace('_', '-')}'] .goals li")
        expect(goals).to_have_count(1 if kind == "stay" else 2)  # else also to reach the space
        expect(goals.last).to_contain_text(sentence)


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

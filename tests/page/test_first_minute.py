"""The first minute: four things to do, and the pop once more, slowly."""

import re

from person import drag_in, events, opened, tab, ticks_come, view
from playwright.sync_api import expect

# View, plot and table show the same time, which is between two, s; the table rounds it to a millisecond.
ONE_MOMENT = """([first, last]) => {
  const text = (at) => document.querySelector(at).textContent;
  const view = document.querySelector(".view canvas").dataset.time;
  const table = parseFloat(text(".phases-when"));
  const same = text(".force-depth .plot-readout").endsWith(`at ${view} s`) && Math.abs(table - view) < 6e-4;
  return same && first <= view && view <= last;
}"""


def drag_out(page, until):
    """Drags the needle out, until the words can be read."""
    box = view(page).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + 0.8 * box["height"]
    page.mouse.move(x, y)
    page.mouse.down()
    for _ in range(400):
        y -= 12
        page.mouse.move(x, y)
        ticks_come(page)
        if until.is_visible():
            break
    page.mouse.up()
    expect(until).to_be_visible()


def test_the_tour_goes_on_as_its_things_are_done_and_the_pop_is_shown_again_slowly_everywhere(page):
    tour = page.get_by_role("region", name="Tour")
    sentence = page.get_by_text("Push until it gives", exact=True)
    expect(tour).to_contain_text("Drag in the view")
    expect(sentence).to_be_visible()
    expect(page.locator(".header")).to_contain_text("Force on")
    drag_in(page, pops=1)
    expect(tour).to_contain_text(re.compile("It gave: the (model |felt )?force fell by"))
    expect(sentence).to_be_hidden()
    drag_out(page, tour.get_by_text("the needle is out"))

    page.get_by_role("combobox", name="Membrane", exact=True).select_option(index=1)
    tour.get_by_role("button", name="Show the pop again, slowly").click()
    bar = page.get_by_role("group", name="Replay")
    expect(bar).to_be_visible()
    bar.get_by_role("button", name="Next event").click()  # the only event of these 100 ms: the pop
    expect(page.locator(".player output")).to_have_text(re.compile(r"[+]\s*0[.]0 ms"))
    told = float(events(page, "pop").locator(".event-time").inner_text().removesuffix(" s"))
    page.wait_for_function(ONE_MOMENT, arg=[told - 6e-4, told + 6e-4])
    # Ticks are counted: their times are those of a real clock, so a busy computer makes some of them longer.
    scrubber = page.get_by_label("Time in the recording")
    pop = int(scrubber.input_value())
    for tick in range(pop + 1, pop + 4):
        bar.get_by_role("button", name="Forward one tick").click()
        expect(scrubber).to_have_value(str(tick))
    page.wait_for_function(ONE_MOMENT, arg=[told + 6e-4, told + 0.05])  # the replay has 50 ms after the pop
    page.get_by_role("button", name="Back to live").click()
    expect(bar).to_be_hidden()

    tour.get_by_role("button", name="Done").click()
    expect(tour).to_be_hidden()
    page.reload()
    expect(events(page, "pop")).to_have_count(1)
    expect(tour).to_be_hidden()
    page.get_by_role("button", name="Tour").click()
    expect(tour).to_contain_text("Drag in the view")


def test_the_question_about_sound_comes_once_after_the_first_pop_and_its_answer_stays(browser, studio):
    with opened(browser, studio.url, sound="") as page:
        question = page.get_by_role("region", name="Sound", exact=True)
        expect(page.locator(".header")).to_contain_text("Force on")
        expect(question).to_be_hidden()
        drag_in(page, pops=1)
        question.get_by_role("button", name="Sound on", exact=True).click()
        expect(question).to_be_hidden()
        page.reload()
        expect(events(page, "pop")).to_have_count(1)
        expect(question).to_be_hidden()
        tab(page, "Hand")
        expect(page.get_by_role("button", name="Sound is on", exact=True)).to_be_visible()

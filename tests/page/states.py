"""The states of the page, one after the other in two visits: what a test checks in all of them."""

from collections.abc import Iterator
from typing import NamedTuple

from person import COMPUTING, events, push, ready, tab, view
from playwright.sync_api import Page, expect
from traced import answer, dropped

SHORT = "A short one"  # an exercise that is over soon after the first contact


class State(NamedTuple):
    """A state of the page. part: where it differs from the states before, as a selector; empty: everywhere."""

    name: str
    part: str = ""


def live_states(page: Page) -> Iterator[State]:
    """Brings a page of the venipuncture, just opened, from state to state."""
    yield from _first(page)
    yield from _tabs(page)
    yield from _trouble(page)


def attempt_states(page: Page) -> Iterator[State]:
    """The same, from the first attempt at an exercise on. The question about sound was answered before."""
    ready(page)
    yield from _exercise(page)
    yield from _recordings(page)
    yield from _lab(page)


def _first(page: Page) -> Iterator[State]:
    expect(page.locator(".tour")).to_be_visible()
    yield State("the tour", ".tour")
    ready(page)
    _push_to_a_pop(page)
    expect(page.locator(".ask-sound")).to_be_visible()
    yield State("live after a pop, with the question about sound")
    page.get_by_role("button", name="No sound").click()
    _push_to_a_pop(page)  # on a busy computer, the page no longer has the ticks of the first one
    view(page).focus()
    page.keyboard.press("r")  # as the callout's button, which leaves the plot with the pop
    expect(page.get_by_role("group", name="Replay")).to_be_visible()
    yield State("the pop once more, slowly", ".player")
    page.keyboard.press("Escape")
    expect(page.get_by_role("group", name="Replay")).to_be_hidden()


def _push_to_a_pop(page: Page) -> None:
    """Until there is one more."""
    pops = events(page, "pop").count()
    for _ in range(20):
        push(page, "Shift+ArrowDown", 5)
        if events(page, "pop").count() > pops:
            break


def _tabs(page: Page) -> Iterator[State]:
    for name in ("Hand", "Recordings", "Health"):
        tab(page, name)
        yield State(f"the tab {name}", ".side")
    tab(page, "Lab").get_by_role("checkbox", name="Estimate").check()
    expect(page.locator(".estimate")).to_be_visible(timeout=COMPUTING)
    yield State("the tab Lab, with the estimate while it runs", ".side")
    page.get_by_role("checkbox", name="Estimate").uncheck()
    side = tab(page, "Scene")
    side.locator(".editor details").evaluate_all("parts => parts.forEach(part => { part.open = true; })")
    expect(side.get_by_text("Tail length").first).to_be_visible()
    page.locator(".view-main .view-tools").get_by_role("button", name="Slice", exact=True).click()
    page.locator(".view-help summary").click()
    friction = page.get_by_role("textbox", name="Friction").first
    before = friction.input_value()
    friction.fill("36")
    friction.press("Enter")
    expect(friction).to_have_attribute("aria-invalid", "true")
    yield State("the whole form with a wrong value, the slice and the help", ".view, .side")
    friction.fill(before)
    friction.press("Enter")
    page.locator(".view-help summary").click()
    page.get_by_role("button", name="Close the slice").click()


def _trouble(page: Page) -> Iterator[State]:
    tab(page, "Health")
    page.get_by_role("button", name="Try a fault").click()
    expect(page.locator(".fault")).to_contain_text("The force is off")
    yield State("a fault", ".header, .fault, .side")
    page.locator(".fault").get_by_role("button", name="Draw the needle out").click()
    page.locator(".fault").get_by_role("button", name="Turn force on").click()
    expect(page.locator(".fault")).to_be_hidden()  # the tabs move up when it goes


def _exercise(page: Page) -> Iterator[State]:
    side = tab(page, "Exercises")
    side.get_by_role("textbox", name="Your name").fill("Ann")
    side.get_by_text("Make an exercise", exact=True).click()
    expect(side.locator(".depth-strip svg")).to_be_visible()
    side.get_by_label("Title").fill("")
    side.get_by_label("Title").press("Tab")
    expect(side.locator(".maker .error:not(:empty)").first).to_be_visible()
    yield State("the exercises and the maker with a problem", ".side")
    side.get_by_text("Make an exercise", exact=True).click()
    card = page.locator("article.exercise", has_text=SHORT)
    card.get_by_role("button", name="Start").click()
    expect(page.locator(".running")).to_be_visible()
    yield State("a running exercise", ".view, .task")
    page.locator(".running").get_by_role("button", name="End").click()
    expect(page.locator(".running")).to_be_hidden()
    expert = card.get_by_role("combobox")
    while expert.locator("option").count() < 2:  # with each focus it reads the list, which has the attempt soon
        expert.blur()
        expert.focus()
        page.wait_for_timeout(200)
    expert.select_option(index=1)
    card.get_by_role("button", name="Start").click()
    dialog = page.get_by_role("dialog")
    expect(page.locator(".running")).to_be_visible()
    expect(page.locator(".header")).to_contain_text("Force on")
    for _ in range(60):
        push(page, "Shift+ArrowDown", 5)
        if dialog.count():
            break
    expect(dialog.locator(".trace svg")).to_be_visible()
    yield State("the result of an exercise beside the expert's run", "dialog")
    dialog.get_by_role("button", name="Replay").click()
    expect(page.get_by_role("group", name="Replay")).to_be_visible()
    yield State("an attempt replayed, with the expert's ghost and the progress", ".view, .force-depth, .player, .side")
    page.get_by_role("button", name="Back to live").first.click()


def _recordings(page: Page) -> Iterator[State]:
    row = tab(page, "Recordings").locator(".recording").first
    row.get_by_role("button", name="Compare").click()
    row.get_by_role("button", name="Delete").click()
    yield State("the list of recordings, one compared, one about to be deleted", ".side")
    row.get_by_role("button", name="Cancel").click()
    row.get_by_role("button", name="Stop").click()


def _lab(page: Page) -> Iterator[State]:
    side = tab(page, "Lab")
    boxes = side.locator(".lab-list input")
    boxes.nth(0).check()
    boxes.nth(1).check()
    side.get_by_role("button", name="Compare 2 runs").click()
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("row", name="mean")).to_contain_text("±")
    yield State("runs compared", "dialog")
    dialog.get_by_role("button", name="Show in the plots").click()
    dialog.get_by_role("button", name="Close", exact=True).click()
    form = dropped(page)
    form.get_by_role("button", name="Identify").click()
    expect(form.get_by_label("Unit of the depth")).to_have_attribute("aria-invalid", "true")
    yield State("a dropped trace with a question unanswered, and a mean in the plots", ".force-depth, .side")
    answer(form)
    form.get_by_role("button", name="Identify").click()
    expect(page.get_by_role("dialog").get_by_role("region", name="Models")).to_be_visible(timeout=COMPUTING)
    yield State("an identified trace", "dialog")
    page.get_by_role("dialog").get_by_role("button", name="Close", exact=True).click()

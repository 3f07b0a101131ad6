"""The states of the studio that its screenshots and checks of accessibility show, and how a person gets there."""

import sys
from pathlib import Path

from playwright.sync_api import Page, expect

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "page"))

from person import PATIENCE, drag_in, push, ready, tab
from stage_states import STAGE, Act, exercise_begun
from traced import answer, dropped


def tour(page: Page) -> None:
    expect(page.get_by_role("region", name="Tour")).to_be_visible(timeout=PATIENCE)
    expect(page.locator(".header")).to_contain_text("Force on", timeout=PATIENCE)


def popped(page: Page) -> None:
    ready(page)
    drag_in(page, pops=1)


def again(page: Page) -> None:
    popped(page)
    page.get_by_role("button", name="Show the pop again, slowly", exact=True).first.click()
    bar = page.get_by_role("group", name="Replay")
    bar.get_by_role("button", name="Next event").click()
    for _ in range(8):
        bar.get_by_role("button", name="Forward one tick").click()


def editor(page: Page) -> None:
    popped(page)
    tab(page, "Scene")
    page.get_by_text("Compare with the other solver").click()


def wrong_value(page: Page) -> None:
    ready(page)
    tab(page, "Scene")
    friction = page.get_by_role("textbox", name="Friction").first
    friction.fill("3.6")
    friction.press("Enter")
    expect(friction).to_have_attribute("aria-invalid", "true", timeout=PATIENCE)


def fault(page: Page) -> None:
    ready(page)
    tab(page, "Health")
    page.get_by_role("button", name="Try a fault").click()
    expect(page.locator(".fault")).to_contain_text("The force is off", timeout=PATIENCE)


def replay(page: Page) -> None:
    ready(page)
    tab(page, "Recordings")
    page.get_by_role("button", name="Record", exact=True).click()
    expect(page.locator(".record-line")).to_contain_text("0 lost", timeout=PATIENCE)
    expect(page.locator(".header")).to_contain_text("Force on", timeout=PATIENCE)
    drag_in(page, pops=1)
    page.get_by_role("button", name="Stop", exact=True).click()
    page.locator(".recording").first.get_by_role("button", name="Replay", exact=True).click()
    bar = page.get_by_role("group", name="Replay")
    expect(bar).to_be_visible(timeout=PATIENCE)
    for _ in range(2):
        bar.get_by_role("button", name="Next event").click()


def exercise(page: Page) -> None:
    exercise_begun(page)
    expect(page.locator(".header")).to_contain_text("Force on", timeout=PATIENCE)
    for _ in range(200):
        push(page, "ArrowDown", 2)
        page.wait_for_timeout(100)  # a hand that keeps pushing and misses the flash-back
        if page.get_by_role("dialog").count():
            break
    expect(page.get_by_role("dialog")).to_contain_text("Peak model force", timeout=PATIENCE)
    expect(page.locator(".trace svg")).to_be_visible(timeout=PATIENCE)


def sliced(page: Page) -> None:
    popped(page)
    page.get_by_role("button", name="Slice", exact=True).click()


def in_the_epidural(page: Page) -> None:
    ready(page)
    push(page, "Shift+ArrowDown", 30)


def projector(page: Page) -> None:
    in_the_epidural(page)
    page.keyboard.press("Alt+p")


def recordings(page: Page) -> None:
    replay(page)
    page.get_by_role("button", name="Back to live").first.click()


def estimate(page: Page) -> None:
    """The Lab's estimate while the run goes on, behind a puncture that it has found."""
    ready(page)
    tab(page, "Lab").get_by_role("checkbox", name="Estimate").check()
    listed = page.locator(".estimate")
    expect(listed).to_be_visible(timeout=PATIENCE)
    drag_in(page, pops=1)
    push(page, "ArrowDown", 12)
    expect(listed).to_contain_text("behind a puncture", timeout=PATIENCE)
    listed.scroll_into_view_if_needed()


def varied(page: Page) -> None:
    ready(page)
    tab(page, "Lab").get_by_role("button", name="Simulate").click()
    expect(page.get_by_role("dialog").get_by_role("row", name="mean")).to_contain_text("±", timeout=PATIENCE)


def measured_tissue(page: Page) -> None:
    ready(page)
    tab(page, "Scene").get_by_text("Measured tissue", exact=True).first.click()


def every_fold(page: Page) -> None:
    ready(page)
    side = tab(page, "Scene")
    side.locator("details").evaluate_all("folds => folds.forEach(fold => { fold.open = true; })")


def identified(page: Page) -> None:
    ready(page)
    form = dropped(page)
    answer(form)
    form.get_by_role("button", name="Identify").click()
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("button", name="Save report")).to_be_enabled(timeout=5 * PATIENCE)  # it computes


def to_parameters(page: Page) -> None:
    """Scrolls the dialog of an identified trace to its parameters."""
    table = page.get_by_role("dialog").get_by_role("region", name="Parameters")
    table.evaluate("e => e.scrollIntoView({block: 'center'})")


def opened_tab(name: str) -> Act:
    def act(page: Page) -> None:
        ready(page)
        tab(page, name)

    return act


def running(page: Page) -> None:
    """The exercise with the longest time, so that it is running until all its pictures are taken."""
    exercise_begun(page, "epidural")
    push(page, "Shift+ArrowDown", 12)


def blind(page: Page) -> None:
    exercise_begun(page, "blind")


def maker(page: Page) -> None:
    ready(page)
    tab(page, "Exercises").get_by_text("Make an exercise", exact=True).click()


def help_open(page: Page) -> None:
    ready(page)
    page.locator(".view-help summary").click()
    page.locator(".header .menu summary").click()


def alone(page: Page) -> None:
    popped(page)
    page.get_by_role("button", name="Maximise Force against depth").click()


# Every state of the bench that has a picture of its own at each size: its name, its scene, and what a person does.
BENCH: tuple[tuple[str, str, Act], ...] = (
    ("tour", "venipuncture", tour),
    ("hand", "epidural", opened_tab("Hand")),
    ("help", "venipuncture", help_open),
    ("pop", "k06-fig10", popped),
    ("vein", "venipuncture", popped),
    ("again", "venipuncture", again),
    ("slice", "venipuncture", sliced),
    ("epidural", "epidural", in_the_epidural),
    ("editor", "k06-fig10", editor),
    ("measured-tissue", "k06-fig10", measured_tissue),
    ("every-fold", "epidural", every_fold),
    ("error", "k06-fig10", wrong_value),
    ("recordings", "k06-fig12", recordings),
    ("replay", "k06-fig12", replay),
    ("exercises", "venipuncture", opened_tab("Exercises")),
    ("maker", "venipuncture", maker),
    ("running", "venipuncture", running),
    ("blind", "two-membranes", blind),
    ("result", "venipuncture", exercise),
    ("lab", "venipuncture", opened_tab("Lab")),
    ("estimate", "k06-fig10", estimate),
    ("varied", "k06-fig10", varied),
    ("trace", "k06-fig10", identified),
    ("health", "k06-fig10", opened_tab("Health")),
    ("fault", "k06-fig10", fault),
    ("alone", "k06-fig10", alone),
    ("projector", "epidural", projector),
)

EVERY = STAGE + BENCH

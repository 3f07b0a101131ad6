"""The stage, which opens first: one sentence, one force, one curve, at most three buttons; the needle always whole."""

import pytest
from axe import AXE, check
from person import NO_WEBGL, opened, ready, tab, view, whole_at
from playwright.sync_api import Page, Route, WebSocketRoute, expect
from studio_process import StudioProcess
from watched_page import COUNT

SIZES = ((1920, 1080), (1440, 900), (1024, 768), (720, 450), (390, 844))
WORDS_WHOLE = """() => [".stage-sentence", ".stage-number", ".stage-buttons"].every((at) => {
  const part = document.querySelector(at);
  const {left, right, top, bottom} = part.getBoundingClientRect();
  const inside = left >= 0 && right <= innerWidth && top >= 0 && bottom <= innerHeight;
  return inside && part.scrollWidth <= part.clientWidth + 1;
})"""
# The needle with hub and syringe, as shares of the view, is inside it, and beside the curve's numbers.
NEEDLE_WHOLE = """() => {
  const [left, top, right, bottom] = document.querySelector(".view canvas").dataset.needle.split(" ").map(Number);
  return left >= 0 && top >= 0 && right <= 1 && bottom <= 1 && right - left + bottom - top > 0.1;
}"""
# The first pop's dot in the tissue is where the tip of the needle was, some mm from where it is now.
AT_TIP = """() => {
  const view = document.querySelector(".view canvas"), dot = document.querySelector(".stage-pops span");
  const [, , right, bottom] = view.dataset.needle.split(" ").map(Number);
  const [a, b] = [view.getBoundingClientRect(), dot.getBoundingClientRect()];
  const [x, y] = [a.left + right * a.width - b.left, a.top + bottom * a.height - b.top];
  return Math.abs(x) < 90 && Math.abs(y) < 60;
}"""
# The rows of the curve's picture in which its line, the darkest thing there, is drawn to the right of the names.
ROWS = """() => {
  const canvas = document.querySelector(".stage-curve canvas");
  const {width, height} = canvas;
  const {data} = canvas.getContext("2d").getImageData(0, 0, width, height);
  const rows = new Set();
  for (let i = 0; i < data.length; i += 4)
    if ((i / 4) % width > 0.35 * width && data[i + 3] > 200 && data[i] + data[i + 1] + data[i + 2] < 180)
      rows.add(Math.floor(i / 4 / width));
  return rows.size;
}"""

# Each pop's mark says which membrane gave way, and no mark lies over the curve's line.
MARKED = """() => {
  const canvas = document.querySelector(".stage-curve canvas");
  const marks = [...document.querySelectorAll(".stage-marks button")];
  const {width, height} = canvas;
  const {data} = canvas.getContext("2d").getImageData(0, 0, width, height);
  let most = 0;
  for (let i = 0; i < data.length; i += 4)
    if (data[i + 3] > 200 && data[i] + data[i + 1] + data[i + 2] < 120) most = Math.max(most, (i / 4) % width);
  const name = (at) => at.offsetWidth > 9 && /skin|vein/.test(at.textContent);
  const named = (mark) => [...mark.querySelectorAll("span")].some(name);
  const from = canvas.getBoundingClientRect().left;
  return marks.length === 3 && marks.every((mark) => named(mark) && mark.getBoundingClientRect().left - from > most);
}"""
# Beside the tissue, nothing of the view is seen through the curve: left, at the numbers of the depth, and right.
OPAQUE = """() => {
  const canvas = document.querySelector(".stage-curve canvas");
  const {width, height} = canvas;
  const row = canvas.getContext("2d").getImageData(0, Math.floor(0.7 * height), width, 1).data;
  return row.length > 0 && row.every((value, i) => i % 4 < 3 || value === 255);
}"""
GOAL_WHOLE = """() => {
  const label = document.querySelector(".view-label.goal");
  return label.hidden || label.scrollWidth <= label.clientWidth;
}"""

# The seconds that twelve frames of the browser take, and what is drawn in them.
DRAWN_MEANWHILE = """() => new Promise((done) => {
  const [before, from] = [{...drawn}, performance.now()];
  const look = () => {
    if (drawn.frames < before.frames + 12) return setTimeout(look, 20);
    const more = Object.keys(drawn).map((what) => [what, drawn[what] - before[what]]);
    done([(performance.now() - from) / 1e3, Object.fromEntries(more)]);
  };
  look();
})"""


@pytest.fixture
def studio(tmp_path):
    with StudioProcess(tmp_path, "venipuncture") as running:
        yield running


@pytest.fixture
def page(browser, studio):
    with opened(browser, studio.url, bench=False) as page:
        expect(page.locator(".stage-number")).to_contain_text("N")
        yield page


def push_step(page: Page) -> None:
    page.keyboard.press("Shift+ArrowDown")
    page.wait_for_timeout(50)


def marks(page: Page):
    return page.locator(".stage-marks button")


def push_to_a_pop(page: Page) -> None:
    view(page).focus()
    for _ in range(200):
        push_step(page)
        if marks(page).count():
            break
    expect(marks(page)).not_to_have_count(0)


def test_the_stage_opens_with_three_buttons_and_the_needle_whole_and_the_bench_is_one_click_or_one_key_away(page):
    expect(page.get_by_role("button")).to_have_count(3)
    expect(page.get_by_role("tab")).to_have_count(0)
    for size in SIZES:
        page.set_viewport_size({"width": size[0], "height": size[1]})
        page.wait_for_function(WORDS_WHOLE)
        page.wait_for_function(NEEDLE_WHOLE)
        page.wait_for_function(OPAQUE)
        assert page.evaluate("document.documentElement.scrollWidth") <= size[0]
    page.set_viewport_size({"width": 1440, "height": 900})

    keys = page.get_by_text("move the needle.")  # words and no frame tell it
    expect(keys).to_be_hidden()
    page.keyboard.press("Tab")
    expect(view(page)).to_be_focused()
    expect(keys).to_be_visible()
    expect(view(page)).to_have_css("outline-style", "none")

    page.get_by_role("button", name="More").click()
    expect(page.get_by_role("tab", name="Lab")).to_be_visible()
    expect(page.locator(".stage-number")).to_be_hidden()
    page.go_back()
    expect(page.locator(".stage-number")).to_be_visible()
    page.go_forward()
    expect(page.get_by_role("tab", name="Lab")).to_be_visible()
    page.reload()
    expect(page.get_by_role("tab", name="Lab")).to_be_visible()
    page.keyboard.press("Alt+b")
    expect(page.locator(".stage-number")).to_be_visible()
    expect(page.get_by_role("tab")).to_have_count(0)
    page.reload()
    expect(page.locator(".stage-number")).to_contain_text("N")
    expect(page.get_by_role("button")).to_have_count(3)


def test_the_curve_keeps_the_whole_attempt_until_again_and_shows_its_pop_again_slowly(page):
    sentence = page.locator(".stage-sentence")
    expect(sentence).to_contain_text("push until it gives")
    before = page.evaluate(ROWS)
    push_to_a_pop(page)
    expect(sentence).to_contain_text("It gave")
    page.wait_for_function(f"() => ({ROWS})() > {before} + 10")
    pushed = page.evaluate(ROWS)
    dots = page.locator(".stage-pops span")
    expect(dots).to_have_count(marks(page).count())
    page.wait_for_function(AT_TIP)
    page.evaluate(AXE.read_text(encoding="utf-8"))
    check(page, "the stage after a pop")
    marks(page).first.click()
    expect(sentence).to_have_text("The pop of the skin, slowly.")
    check(page, "a pop on the stage, slowly")
    replay = page.get_by_role("group", name="Replay")
    expect(replay.get_by_role("button")).to_have_count(1)  # plays and pauses; the way back is the stage's "Go on"
    expect(replay.get_by_role("button", name="Play")).to_be_visible()
    page.get_by_role("button", name="Go on").click()
    expect(replay).to_be_hidden()
    expect(marks(page)).not_to_have_count(0)
    page.get_by_role("button", name="Again", exact=True).click()
    expect(dots).to_have_count(0)
    expect(marks(page)).to_have_count(0)
    expect(sentence).to_contain_text("the needle is out")
    page.wait_for_function(f"() => ({ROWS})() < ({before} + {pushed}) / 2")  # what is left is the way out, in air


def test_each_pop_has_its_name_beside_the_curve(page):
    view(page).focus()
    for _ in range(200):
        push_step(page)
        if marks(page).count() == 3:
            break
    for size in SIZES:
        page.set_viewport_size({"width": size[0], "height": size[1]})
        page.wait_for_function(MARKED)


def test_a_held_key_goes_on_moving_the_needle_while_the_bench_comes(page):
    """After a pop the bench is loaded. Somebody who draws the needle back by then holds the key down."""
    chunks: list[Route] = []
    page.route("**/bench-*.js", lambda chunk: chunks.append(chunk))
    push_to_a_pop(page)
    page.keyboard.down("ArrowUp")  # one key-down event, as of a keyboard that repeats nothing
    page.wait_for_timeout(500)
    for chunk in chunks:
        chunk.continue_()
    expect(page.locator(".side")).to_be_attached()
    expect(page.locator(".stage-sentence")).to_contain_text("the needle is out")
    page.keyboard.up("ArrowUp")
    expect(view(page)).to_be_focused()


def test_without_webgl_the_slice_is_the_stage_and_a_drag_along_its_needle_goes_through_the_skin(browser, studio):
    with opened(browser, studio.url, script=NO_WEBGL, bench=False) as page:
        expect(page.locator(".slice canvas")).to_be_visible()
        expect(page.locator(".stage-number")).to_contain_text("N")
        box = page.locator(".view-pad").bounding_box()
        assert box
        x, y = box["x"] + 0.1 * box["width"], box["y"] + 0.1 * box["height"]
        page.mouse.move(x, y)
        page.mouse.down()
        for step in range(100):
            page.mouse.move(x + 0.87 * 8 * step, y + 0.5 * 8 * step)
            page.wait_for_timeout(50)
            if marks(page).count():
                break
        page.mouse.up()
        expect(marks(page)).not_to_have_count(0)


def test_without_webgl_an_exercise_takes_the_keys_and_the_curve_shows_its_goal(browser, studio):
    with opened(browser, studio.url, script=NO_WEBGL, bench=False) as page:
        page.get_by_role("button", name="More").click()
        ready(page)
        tab(page, "Exercises")
        page.locator("[data-exercise=venipuncture]").get_by_role("button", name="Start").click()
        expect(page.locator(".stage-goal")).to_have_text("Goal: the vein")
        expect(page.locator(".view-main")).to_be_focused()
        page.keyboard.press("ArrowDown")
        expect(page.locator(".stage-keys")).to_be_visible()


def test_with_a_device_the_stage_has_the_state_of_the_force_and_its_button(page):
    simulated, real = '"simulated":true', '"simulated":false'

    def as_a_device(page_side: WebSocketRoute) -> None:
        studio_side = page_side.connect_to_server()
        studio_side.on_message(lambda m: page_side.send(m.replace(simulated, real) if isinstance(m, str) else m))

    page.route_web_socket("**", as_a_device)
    page.reload()
    state = page.locator(".stage-buttons .servo-state")
    expect(state).to_contain_text("Force on")
    page.get_by_role("button", name="Turn force off").click()
    expect(state).to_contain_text("Force off")
    for size in SIZES:
        page.set_viewport_size({"width": size[0], "height": size[1]})
        page.wait_for_function(WORDS_WHOLE)


def test_the_sentence_is_bound_to_the_place_of_the_needle(page):
    sentence = page.locator(".stage-sentence")
    push_to_a_pop(page)
    page.keyboard.press("Home")
    expect(sentence).to_contain_text("the needle is out")
    for _ in range(200):
        push_step(page)
        if "is out" not in (sentence.text_content() or ""):
            break
    expect(sentence).to_contain_text("The tip is in the")


def test_an_exercise_leads_back_to_the_stage_with_its_goals_and_its_clock(page):
    page.get_by_role("button", name="More").click()
    ready(page)
    tab(page, "Exercises")
    card = page.locator("article.exercise", has_text="Steady push")
    card.get_by_role("button", name="Start").click()
    expect(page.locator(".stage-sentence")).to_contain_text("Push straight down")
    running = page.locator(".running")
    expect(running.locator(".instruction")).to_be_hidden()  # it is said once
    expect(view(page)).to_be_focused()
    page.evaluate(AXE.read_text(encoding="utf-8"))
    check(page, "the stage in an exercise")
    for size in SIZES:
        whole_at(page, size, running.get_by_role("timer"), running.get_by_role("button", name="End"))
        page.wait_for_function(WORDS_WHOLE)
        page.wait_for_function(NEEDLE_WHOLE)
        page.wait_for_function("document.querySelector('.stage-free').clientHeight > 0.25 * innerHeight")
        page.wait_for_function(GOAL_WHOLE)
    hold = running.get_by_text("Hold the whole tip behind the membrane")
    expect(hold).to_be_hidden()  # a phone has no room for what is to come
    page.set_viewport_size({"width": 1440, "height": 900})
    expect(hold).to_be_visible()
    running.get_by_role("button", name="End").click()
    expect(running).to_be_hidden()
    expect(page.locator(".stage-number")).to_be_visible()


def test_a_blind_exercise_has_its_words_on_the_stage_of_a_phone(page):
    page.get_by_role("button", name="More").click()
    ready(page)
    tab(page, "Exercises")
    page.locator("article.exercise", has_text="Blind").get_by_role("button", name="Start").click()
    expect(page.locator(".stage-sentence")).to_contain_text("Push slowly")
    page.set_viewport_size({"width": 390, "height": 844})
    page.wait_for_function(WORDS_WHOLE)


@pytest.mark.parametrize("bench", [False, True])
def test_a_needle_at_rest_costs_no_pictures_of_view_and_curve_and_one_of_a_plot_a_second(browser, studio, bench):
    with opened(browser, studio.url, script=COUNT, bench=bench) as page:
        expect(page.locator(".view canvas")).to_be_visible()
        if bench:
            ready(page)
        for _ in range(60):  # until the view has its full sharpness
            seconds, drawn = page.evaluate(DRAWN_MEANWHILE)
            if drawn["view"] == drawn["curve"] == 0:
                break
        assert drawn["view"] == drawn["curve"] == 0
        assert drawn["plots"] <= (seconds + 1 if bench else 0)

"""A measured trace is dropped into the page: its questions, its fit, its verdict, and the tissue to feel."""

import re

import punctura as pn
from person import COMPUTING, drag_in, events, ready, saved
from playwright.sync_api import Page, expect
from traced import DROP, answer, dropped, measured


def test_a_trace_is_dropped_identified_and_felt(page: Page, tmp_path):
    ready(page)
    form = dropped(page)
    expect(form.get_by_label("Column of the depth")).to_have_value("depth")
    form.get_by_role("button", name="Identify").click()
    expect(form.get_by_label("Unit of the depth")).to_have_attribute("aria-invalid", "true")
    expect(form).to_contain_text("Choose the unit of the depth")
    answer(form)
    page.route("**/api/lab/identify?*", lambda route: None)  # an answer that does not come
    form.get_by_role("button", name="Identify").click()
    page.get_by_role("button", name="Cancel").click()
    expect(form.get_by_role("button", name="Identify")).to_be_enabled()
    page.unroute_all(behavior="ignoreErrors")
    form.get_by_role("button", name="Identify").click()

    dialog = page.get_by_role("dialog")
    follows = re.compile(r"K06 with one membrane follows the force to 9\.[45] mN rms")
    expect(dialog).to_contain_text(follows, timeout=COMPUTING)
    expect(dialog.get_by_role("row", name="Membrane 1: friction")).to_contain_text("0.19")
    expect(dialog).to_contain_text("insert a second time at the same place")
    expect(dialog.get_by_role("region", name="Models").get_by_role("row")).to_have_count(11)
    expect(dialog).to_contain_text("it fits best")
    dialog.get_by_label("Another model").select_option("dahl")
    expect(dialog.locator(".plot-legend")).to_contain_text("Dahl with viscosity")
    report = saved(page, dialog.get_by_role("button", name="Save report"), tmp_path)
    assert report.read_text(encoding="utf-8").startswith("<!doctype html>")
    scene = saved(page, dialog.get_by_role("button", name="Save scene"), tmp_path)
    assert pn.load_scene(scene).name == "insertion.csv"

    dialog.get_by_role("button", name="Feel this tissue").click()
    expect(dialog).to_be_hidden()
    expect(page.locator(".phases")).to_contain_text("membrane 1")
    expect(page.locator(".header")).to_contain_text("Force on")
    drag_in(page, pops=1)
    expect(events(page, "pop").first).to_contain_text("membrane 1")


def test_a_trace_that_states_everything_is_drawn_at_once_and_the_next_file_waits(page: Page):
    ready(page)
    part = page.locator(".trace-part")
    page.route("**/api/lab/file?name=first.csv", lambda route: None)  # an answer that does not come
    page.evaluate(DROP, ["first.csv", measured()])
    expect(part).to_contain_text("reading first.csv")
    page.evaluate(DROP, ["second.csv", measured().replace("depth", "depth_mm", 1)])
    expect(part).to_contain_text("second.csv waits until the present computation is done.")
    page.get_by_role("button", name="Cancel").click()
    expect(part.get_by_role("img", name="second.csv: force against depth")).to_be_visible()
    expect(part.get_by_role("button", name="Identify")).to_be_enabled()

"""The page when its server goes, and when someone else looks on."""

from chromium import on_the_bench
from person import ready
from playwright.sync_api import expect
from studio_process import StudioProcess

# What a browser does whose user forbids pages to keep data.
NO_STORAGE = """for (const which of ["localStorage", "sessionStorage"])
  Object.defineProperty(window, which, {get() { throw new DOMException("", "SecurityError"); }});"""


def test_the_token_leaves_the_address_bar_and_the_page_says_that_the_studio_has_gone_and_comes_back_with_it(
    page, studio, tmp_path
):
    ready(page)
    assert page.url == studio.url.split("?")[0]
    page.reload()
    ready(page)
    assert page.url == studio.url.split("?")[0]
    assert studio.end() in (0, 130)
    expect(page.locator(".header")).to_contain_text("No connection")
    token = studio.url.split("token=")[1]
    with StudioProcess(tmp_path, "k06-fig10", port=studio.port, token=token):
        expect(page.locator(".connection-words")).to_have_text("Connected")


def test_a_page_whose_token_is_of_another_run_says_so_and_tries_no_more(page, studio, tmp_path):
    ready(page)
    assert studio.end() in (0, 130)
    with StudioProcess(tmp_path, "k06-fig10", port=studio.port, token="of-another-run-0123"):
        expect(page.locator(".connection-words")).to_contain_text("Refused: This needs the token")


def test_a_second_page_may_only_turn_the_force_off_until_it_takes_control(page, studio, browser):
    ready(page)
    second = browser.new_page()
    on_the_bench(second.context)
    second.add_init_script(NO_STORAGE)
    second.goto(studio.url)
    expect(second.get_by_role("button", name="Take control").first).to_be_visible()
    second.get_by_role("button", name="Turn force off").click()
    expect(second.get_by_role("button", name="Turn force on")).to_be_disabled()
    second.get_by_role("button", name="Take control").first.click()
    expect(page.get_by_role("button", name="Take control").first).to_be_visible()
    assert second.url == studio.url  # a page that may keep nothing needs the token there for a reload
    second.close()

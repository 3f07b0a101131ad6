"""A participant's session at the page, by keys alone."""

import re

from person import opened
from playwright.sync_api import expect
from punctura.perception import Observer, Simulation, load_protocol, write_report
from senses import STUBS
from sitting import PROTOCOL, answered, on_disk, sentence, sitting, until

# Whether an empty box shows all of what may be typed.
FITS = """box => {
  const style = getComputedStyle(box), pen = document.createElement("canvas").getContext("2d");
  pen.font = `${style.fontSize} ${style.fontFamily}`;
  return pen.measureText(box.placeholder).width <= box.clientWidth - 2 * parseFloat(style.paddingLeft);
}"""


def test_a_session_by_keys_shows_one_sentence_and_goes_on_after_a_kill(browser, tmp_path):
    answered(tmp_path, 18)
    with sitting(tmp_path) as studio, opened(browser, studio.url, sound="on", bench=False) as page:
        sentence(page, "18 of 20 trials are done.")
        expect(page.get_by_text("Eine Taste bringt den Ton.")).to_be_visible()
        page.keyboard.press("Enter")
        sentence(page, "Trial 19 of 20: push the needle through the tissue")
        expect(page.get_by_text("Eine Taste bringt den Ton.")).to_be_hidden()
        page.evaluate("document.querySelector('.fault').append('The force is off.')")  # the sentence tells it
        expect(page.locator(".fault")).to_be_hidden()
        expect(page.locator(".stage-force")).to_be_hidden()
        expect(page.locator(".stage-curve")).to_be_hidden()
        assert page.locator(".stage-cut").evaluate("cut => { cut.textContent = 'Cut.'; return cut.offsetWidth; }") == 0
        expect(page.locator(".view-main > canvas")).to_have_css("opacity", "0")
        expect(page.get_by_role("button")).to_have_count(1)  # turns the force off
        until(page, "Did it pop?")
        for name in ("yes", "no"):
            box = page.get_by_role("button", name=name).bounding_box()
            assert box and min(box["width"], box["height"]) >= 44
        page.keyboard.press("y")
        until(page, "Trial 20 of 20")
        until(page, "Did it pop?")
        assert len(on_disk(tmp_path)) == 19
        studio.kill()
        sentence(page, "Das Studio ist weg.")
        expect(page.get_by_role("button")).to_have_text(["Kraft aus (Esc)"])
        with sitting(tmp_path, studio.port):
            sentence(page, "19 of 20 trials are done.")
            page.keyboard.press("Enter")
            until(page, "Did it pop?")
            page.keyboard.press("n")
            sentence(page, "That was the last trial.")
        assert "masking noise" not in studio.log()
    assert [line.answer for line in on_disk(tmp_path)][18:] == ["yes", "no"]


def test_a_full_word_gives_consent_and_a_key_does_not(browser, tmp_path):
    (tmp_path / "mine.toml").write_text(PROTOCOL)
    with sitting(tmp_path) as studio, opened(browser, studio.url, bench=False) as page:
        sentence(page, "I take part. Do you agree?")
        typed = page.get_by_placeholder("Type yes or no, then Enter")
        assert typed.evaluate(FITS)
        page.keyboard.type("y")
        expect(typed).to_have_value("y")
        page.keyboard.press("Enter")
        expect(typed).to_have_value("")
        assert not (tmp_path / "people" / "P01.jsonl").exists()
        page.keyboard.type("Yes")
        page.keyboard.press("Enter")
        sentence(page, "The session begins.")


def test_nothing_but_the_force_tells_of_a_pop_though_the_browser_remembers_bench_and_sound(browser, tmp_path):
    answered(tmp_path, 18)
    with sitting(tmp_path) as studio, opened(browser, studio.url, sound="on", script=STUBS) as page:
        sentence(page, "18 of 20 trials are done.")
        page.keyboard.press("Enter")
        sentence(page, "Trial 19 of 20: push")
        until(page, "Did it pop?")
        assert page.evaluate("[heard, rumbled]") == [["friction"] * 2, []]  # one whose volume stays 0, and the masking
        assert "warning: No haptic device" in studio.log() and "on PHANTOM Omni, simulated" in studio.log()


def test_a_report_of_three_people_prints_on_one_page(browser, tmp_path):
    simulation = Simulation(load_protocol("pop-jnd"), Observer())
    for name in ("P01", "P02", "P03"):
        simulation.run_on_disk(tmp_path, name, 1)
    write_report(simulation.protocol, tmp_path)
    with browser.new_page() as page:
        page.goto((tmp_path / "report.html").as_uri())
        assert len(re.findall(rb"/Type\s*/Page\b", page.pdf(prefer_css_page_size=True))) == 1

"""axe-core in the page: rules of accessibility, checked in the page's present state."""

import json
from pathlib import Path

from person import PATIENCE
from playwright.sync_api import Page

AXE = Path(__file__).parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
USUAL = (1440, 900)
LARGE, TABLET, PHONE = (1920, 1080), (1024, 768), (390, 844)
COLOURS = ["color-contrast", "link-in-text-block"]
LAYOUT = ["scrollable-region-focusable", "target-size"]  # what the size of the window changes
# Most of the page is hidden, and axe-core looks at all that is there, for each rule. seen: the rest is not there then.
RUN = """async ([rules, parts, seen]) => {
  const hides = (part) => getComputedStyle(part).display === 'none' && part.parentElement.checkVisibility();
  const inside = seen ? [...document.body.querySelectorAll(':has(*)')].filter(hides) : [];
  const hidden = inside.map((part) => [part, [...part.childNodes]]);
  for (const [part] of hidden) part.replaceChildren();
  const found = await axe.run(parts ? {include: parts} : document, {resultTypes: ['violations'], ...rules});
  for (const [part, children] of hidden) if (!part.hasChildNodes()) part.append(...children);
  return found.violations.filter(({impact}) => impact !== 'minor').map(({id, impact, nodes}) =>
    ({id, impact, nodes: nodes.map(({html, failureSummary}) => [html.slice(0, 200), failureSummary])}));
}"""
NEXT_PICTURE = "() => new Promise((done) => requestAnimationFrame(done))"  # the page's draws come before it
TARGETS = {"rules": {"target-size": {"enabled": True}}}  # WCAG 2.2; axe-core leaves it out by default


def check(page: Page, state: str, part: str = "") -> None:
    """All rules in light colours at the usual size; elsewhere the rules about layout and colours.

    A part is also checked in dark colours on a phone, where parts lie over others. A state of the whole page is checked
    in dark colours in a large window and on a tablet, and in light ones on a phone. part: a selector of what differs
    from the states before; empty: the page. At none of the sizes may the page scroll sideways. The page stays in light
    colours and at the usual size.
    """
    _none(page, f"{state}, light", TARGETS, part)
    _fits(page, state, USUAL)
    if part:
        _at(page, state, TABLET, "dark", [], part)
        _at(page, state, PHONE, "dark", LAYOUT + COLOURS, part)
    else:
        for size, colours in ((LARGE, "dark"), (TABLET, "dark"), (PHONE, "light")):
            _at(page, state, size, colours, LAYOUT + COLOURS)
    page.emulate_media(color_scheme="light")
    page.set_viewport_size({"width": USUAL[0], "height": USUAL[1]})


def _at(page: Page, state: str, size: tuple[int, int], colours: str, rules: list[str], part: str = "") -> None:
    page.emulate_media(color_scheme=colours)
    page.set_viewport_size({"width": size[0], "height": size[1]})
    _in_time(page, NEXT_PICTURE)
    if rules:
        _none(page, f"{state}, {size[0]} px wide, {colours}", {"runOnly": {"type": "rule", "values": rules}}, part)
    _fits(page, state, size)


def _fits(page: Page, state: str, size: tuple[int, int]) -> None:
    width = page.evaluate("document.documentElement.scrollWidth")
    assert width <= size[0], f"{state} scrolls sideways at {size[0]} px"


def none_found(page: Page, state: str) -> None:
    """All rules in the page's present size and colours."""
    _none(page, state, TARGETS)


def _none(page: Page, state: str, rules: dict[str, object], part: str = "") -> None:
    """All rules on the whole page are also for what is hidden: each id is there once."""
    seen = bool(part) or rules is not TARGETS
    found = _in_time(page, RUN, [rules, part.split(", ") if part else None, seen])
    assert not found, f"{state}: {json.dumps(found, indent=1)}"


def _in_time(page: Page, script: str, given: object = None) -> object:
    """What the script's promise gives. Playwright alone waits for a promise without an end."""
    late = f"new Promise((_, fail) => setTimeout(() => fail(new Error('no answer from the page')), {PATIENCE}))"
    return page.evaluate(f"(given) => Promise.race([({script})(given), {late}])", given)

"""axe-core in the page: rules of accessibility, checked in the page's present state."""

import json
from pathlib import Path

from playwright.sync_api import Page

AXE = Path(__file__).parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
USUAL = (1440, 900)
LARGE, TABLET, PHONE = (1920, 1080), (1024, 768), (390, 844)
COLOURS = ["color-contrast", "link-in-text-block"]
LAYOUT = ["scrollable-region-focusable", "target-size"]  # what the size of the window changes
RUN = """async ([rules, parts]) => {
  const found = await axe.run(parts ? {include: parts} : document, {resultTypes: ['violations'], ...rules});
  return found.violations.filter(({impact}) => impact !== 'minor').map(({id, impact, nodes}) =>
    ({id, impact, nodes: nodes.map(({html, failureSummary}) => [html.slice(0, 200), failureSummary])}));
}"""
TARGETS = {"rules": {"target-size": {"enabled": True}}}  # WCAG 2.2; axe-core leaves it out by default


def check(page: Page, state: str, part: str = "") -> None:
    """All rules in light colours at the usual size; the rules about colours in dark ones, about layout at other sizes.

    The rules about colours also apply at a phone's size, where parts lie over others; in a state of the whole page also
    in dark colours, and on a tablet.
    part: a selector of what differs from the states before; empty: the page. At no size may the page scroll sideways.
    The page stays in light colours and at the usual size.
    """
    _none(page, f"{state}, light", TARGETS, part)
    page.emulate_media(color_scheme="dark")
    _none(page, f"{state}, dark", _only(COLOURS), part)
    page.emulate_media(color_scheme="light")
    for width, height in (LARGE, TABLET, PHONE):
        page.set_viewport_size({"width": width, "height": height})
        rules = LAYOUT + COLOURS if (width, height) == PHONE or not part else LAYOUT
        _none(page, f"{state}, {width} px wide", _only(rules), part)
        assert page.evaluate("document.documentElement.scrollWidth") <= width, f"{state} scrolls sideways at {width} px"
        if not part and (width, height) != LARGE:
            page.emulate_media(color_scheme="dark")
            _none(page, f"{state}, {width} px wide, dark", _only(COLOURS))
            page.emulate_media(color_scheme="light")
    page.set_viewport_size({"width": USUAL[0], "height": USUAL[1]})


def none_found(page: Page, state: str) -> None:
    """All rules in the page's present size and colours."""
    _none(page, state, TARGETS)


def _only(rules: list[str]) -> dict[str, object]:
    return {"runOnly": {"type": "rule", "values": rules}}


def _none(page: Page, state: str, rules: dict[str, object], part: str = "") -> None:
    found = page.evaluate(RUN, [rules, part.split(", ") if part else None])
    assert not found, f"{state}: {json.dumps(found, indent=1)}"

"""axe-core in the page: rules of accessibility, checked in the page's present state."""

import json
from pathlib import Path

from playwright.sync_api import Page

AXE = Path(__file__).parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
COLOURS = ["color-contrast", "link-in-text-block"]
RUN = """async (only) => (await axe.run(document, {resultTypes: ['violations'], ...only})).violations
  .filter(({impact}) => impact !== 'minor')
  .map(({id, impact, nodes}) => ({id, impact, nodes: nodes.map(({html, failureSummary}) => [html.slice(0, 200),
    failureSummary])}))"""


def check(page: Page, state: str) -> None:
    """Light with all rules. Dark, which differs only in its colours, with the rules about colours."""
    for scheme, only in (("light", {}), ("dark", {"runOnly": {"type": "rule", "values": COLOURS}})):
        page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
        found = page.evaluate(RUN, only)
        assert not found, f"{state}, {scheme}: {json.dumps(found, indent=1)}"

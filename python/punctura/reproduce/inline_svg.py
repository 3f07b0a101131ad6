"""Converts an SVG file to a page element: no header, unique ids, and colours from the page's style sheet."""

from __future__ import annotations

import re

from punctura.reproduce import palette


def inline_svg(svg: str, name: str, alt: str) -> str:
    """The <svg> element. The page's style sheet must define `--colour-…` for every colour of the palette."""
    body = svg[svg.index("<svg") :]
    body = re.sub(r"<metadata>.*?</metadata>", "", body, flags=re.DOTALL)
    body = re.sub(r'<style type="text/css">.*?</style>', "", body, flags=re.DOTALL)
    body = re.sub(r'\bid="([^"]+)"', rf'id="{name}-\1"', body)
    body = re.sub(r"url\(#([^)]+)\)", rf"url(#{name}-\1)", body)
    body = re.sub(r'href="#([^"]+)"', rf'href="#{name}-\1"', body)
    for colour in palette.ALL:
        body = body.replace(colour.light, f"var(--colour-{colour.name})")
    # The page sets the size. The view box keeps the aspect ratio.
    body = re.sub(r'(<svg[^>]*?) width="[^"]*"', r"\1", body, count=1)
    body = re.sub(r'(<svg[^>]*?) height="[^"]*"', r"\1", body, count=1)
    return body.replace("<svg", f'<svg class="figure" role="img" aria-label="{alt}"', 1)


def colour_rules() -> str:
    """The palette as CSS, light and dark."""
    light = "".join(f"--colour-{c.name}:{c.light};" for c in palette.ALL)
    dark = "".join(f"--colour-{c.name}:{c.dark};" for c in palette.ALL)
    return f":root{{color-scheme:light dark;{light}}}\n@media (prefers-color-scheme:dark){{:root{{{dark}}}}}\n"

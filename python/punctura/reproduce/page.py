"""The page of figures: one file, usable offline, light and dark."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from importlib.resources import files
from pathlib import Path

from punctura.reproduce.drawing import Drawing, Measured
from punctura.reproduce.inline_svg import colour_rules, inline_svg
from punctura.reproduce.parameters import parameters
from punctura.reproduce.versions import versions
from punctura.reproduce.words import read_words


def write_page(drawings: Sequence[Drawing], folder: Path, name: str) -> None:
    """Writes the page. The files of the drawings must already be in `folder`."""
    words = read_words("page")
    sections = "\n".join(_section(drawing, folder) for drawing in drawings)
    links = [(d.name, d.words.title.split(":")[0]) for d in drawings] + [
        ("numbers", "Numbers"),
        ("parameters", "Parameters"),
    ]
    nav = "".join(f'<a href="#{anchor}">{escape(text)}</a>' for anchor, text in links)
    css = files("punctura.reproduce").joinpath("page.css").read_text(encoding="utf-8")
    made_with = ", ".join(f"{escape(what)} {escape(which)}" for what, which in versions().items() if what != "system")
    html = f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{escape(words.title)}</title>
<style>
{colour_rules()}{css}</style>
</head>
<body>
<header>
<h1>{escape(words.title)}</h1>
{_paragraphs(words.text)}
<nav>{nav}</nav>
</header>
<main>
{sections}
{_numbers([m for d in drawings for m in d.measured])}
{_parameters()}
</main>
<footer><p>Made by <code>punctura reproduce</code> with {made_with}, on {escape(versions()["system"])}.
The same seed gives the same numbers.</p></footer>
</body>
</html>
"""
    (folder / name).write_text(html, encoding="utf-8")


def _section(drawing: Drawing, folder: Path) -> str:
    svg = (folder / f"{drawing.name}.svg").read_text(encoding="utf-8")
    picture = inline_svg(svg, drawing.name, escape(drawing.words.alt, quote=True))
    names = [f"{drawing.name}.png", f"{drawing.name}.svg", *(f"{table}.csv" for table in drawing.tables)]
    links = "".join(f'<a href="{escape(name)}">{escape(name)}</a>' for name in names)
    return f"""<section id="{drawing.name}">
<h2>{escape(drawing.words.title)}</h2>
<figure>{picture}</figure>
{_paragraphs(drawing.words.text)}
<div class="files">{links}</div>
</section>"""


def _paragraphs(text: Sequence[str]) -> str:
    return "\n".join(f"<p>{escape(paragraph)}</p>" for paragraph in text)


def _numbers(measured: Sequence[Measured]) -> str:
    rows = "\n".join(
        f"<tr><td>{escape(m.figure)}</td><td>{escape(m.quantity)}</td>"
        f'<td class="number">{_number(m.expected, m.unit)}</td><td class="number">{_number(m.measured, m.unit)}</td>'
        f"<td>{escape(m.source)}</td></tr>"
        for m in measured
    )
    return f"""<section id="numbers">
<h2>Measured in this run, and expected</h2>
<p>The expected value is the law's value for an infinitely slow needle. A run samples the law once per tick, so its
peaks are slightly lower.</p>
<div class="wide"><table>
<thead><tr><th>figure</th><th>quantity</th><th class="number">expected</th><th class="number">measured</th>
<th>expected from</th></tr></thead>
<tbody>
{rows}
</tbody></table></div>
</section>"""


def _number(value: float, unit: str) -> str:
    if value != value:
        return ""
    return f"{value:.0f}" if not unit else f"{value:.4f} {unit}"


def _parameters() -> str:
    rows = "\n".join(
        f'<tr><td>{escape(p.group)}</td><td>{escape(p.name)}</td><td class="number">{escape(p.value)}</td>'
        f"<td>{escape(p.source)}</td></tr>"
        for p in parameters()
    )
    return f"""<section id="parameters">
<h2>Parameters</h2>
<div class="wide"><table>
<thead><tr><th>group</th><th>parameter</th><th class="number">value</th><th>source</th></tr></thead>
<tbody>
{rows}
</tbody></table></div>
</section>"""
